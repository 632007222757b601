!> Version, texts of status codes and infinity of the library in C
module gapbeam_capi_library
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_loc, c_null_char
    use gapbeam_error, only: status_codes, status_texts, unknown_status
    use gapbeam_version, only: gapbeam_version_major, gapbeam_version_minor, gapbeam_version_patch, gapbeam_version_string
    use gapbeam_scene, only: gapbeam_inf => gapbeam_infinity
    implicit none
    private

    !> Constants whose addresses C is given, never written to; and what counts them where they are listed
    integer :: i_text
    character(len=len(status_texts) + 1), target :: texts(size(status_texts)) = [character(len=len(status_texts) + 1) :: &
        (trim(status_texts(i_text))//c_null_char, i_text=1, size(status_texts))]
    character(len=len(unknown_status) + 1), target :: no_text = unknown_status//c_null_char
    character(len=len(gapbeam_version_string) + 1), target :: version = gapbeam_version_string//c_null_char

contains

    subroutine gapbeam_get_version(major, minor, patch) bind(c)
        integer(c_int), intent(out), optional :: major, minor, patch

        if (present(major)) major = gapbeam_version_major
        if (present(minor)) minor = gapbeam_version_minor
        if (present(patch)) patch = gapbeam_version_patch
    end subroutine gapbeam_get_version

    function gapbeam_version_text() result(text) bind(c)
        type(c_ptr) :: text

        text = c_loc(version)
    end function gapbeam_version_text

    function gapbeam_status_message(status) result(text) bind(c)
        integer(c_int), intent(in), value :: status
        type(c_ptr) :: text
        integer :: i

        i = findloc(status_codes, int(status), 1)
        text = c_loc(no_text)
        if (i > 0) text = c_loc(texts(i))
    end function gapbeam_status_message

    function gapbeam_infinity() result(value) bind(c)
        real(c_double) :: value

        value = gapbeam_inf
    end function gapbeam_infinity

end module gapbeam_capi_library

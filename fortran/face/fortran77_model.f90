!> Models from the arrays of the Fortran 77 interface: what GHPREP, GHPRLW, GHPRSL, GHPRFR, GHPRFD, GHPRAF and GHPRSC do
module gapbeam_fortran77_model
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_bad_input
    use gapbeam_laws, only: parameters_of_law, parameters_of
    use gapbeam_scene, only: model_type, gapbeam_table_of_gap
    use gapbeam_input_error, only: of_spans, of_supports, of_sections, of_foundations, not_expected
    use gapbeam_arrays, only: model_from_arrays, foundations_from_arrays
    use gapbeam_handles, only: handle_type, number_of
    use gapbeam_new_objects, only: new_beam
    implicit none
    private
    public :: prepare

contains

    !> Prepare a beam, with the arguments of GHPRFD
    subroutine prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                       found, nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, beam, ientry, info, islaw, &
                       slaw, fric, axial, shear, igrow, nmass, amass, nsec, isec, sec)
        integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw, ntab
        real(wp), intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *), &
                                glaw(2*parameters_of_law, *), atab(2, *)
        integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*), itab(2, *)
        integer(int64), intent(out) :: beam
        integer, intent(out) :: ientry, info
        !> Laws of supports by name and their parameters, as for GHPRSL
        integer, intent(in), optional :: islaw(*)
        real(wp), intent(in), optional :: slaw(parameters_of_law, *)
        !> Friction coefficients of supports, as for GHPRFR
        real(wp), intent(in), optional :: fric(*)
        !> Axial forces and masses of spans, second parameters of foundations, whether the axial forces grow, lumped masses, as for
        !> GHPRAF
        real(wp), intent(in), optional :: axial(2, *), shear(*), amass(2, *)
        integer, intent(in), optional :: igrow, nmass
        !> Sections, as for GHPRSC
        integer, intent(in), optional :: nsec, isec(3, *)
        real(wp), intent(in), optional :: sec(12, *)
        !> Arguments that are numbers of entries
        integer, parameter :: place_of_count(9) = [1, 3, 5, 8, 11, 15, 18, 21, 26]
        type(model_type) :: model
        type(handle_type), pointer :: handle
        type(error_type), allocatable :: error
        real(wp), allocatable :: spans(:, :), hinges(:, :), sections(:, :), supports(:, :), ground(:, :), points(:, :)
        integer, allocatable :: codes(:, :), owners(:)
        integer :: k, number, stat

        beam = 0
        ientry = 0
        info = 0
        if (present(nsec)) info = merge(-34, info, nsec < 0)
        if (present(nmass)) info = merge(-32, info, nmass < 0)
        if (present(igrow)) info = merge(-31, info, igrow < 0 .or. igrow > 15)
        k = findloc([nspan - 1, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw, ntab] < 0, .true., 1)
        if (k > 0) info = -place_of_count(k)
        if (info /= 0) return
        number = 0
        if (present(nsec)) number = nsec
        allocate (spans(6, nspan), hinges(2, nhinge), sections(15, number), supports(9, nsup), ground(14, nfound), &
                  points(3, nprof + ntab), source=0.0_wp, stat=stat)
        if (stat == 0) allocate (codes(5, nsup), owners(nprof + ntab), source=0, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
        else
            spans(:4, :) = span(:, 1:nspan)
            if (present(axial)) spans(5:, :) = axial(:, 1:nspan)
            hinges(1, :) = hinge(1:nhinge)
            if (present(sec)) sections(:12, :) = sec(:, 1:number)
            if (present(isec)) sections(13:, :) = isec(:, 1:number)
            codes(:3, :) = isup(:, 1:nsup)
            if (nlaw > 0 .or. present(islaw)) codes(4, :) = iunl(1:nsup)
            if (present(islaw)) codes(5, :) = islaw(1:nsup)
            supports(:5, :) = sup(:, 1:nsup)
            if (present(slaw)) supports(6:8, :) = slaw(:, 1:nsup)
            if (present(fric)) supports(9, :) = fric(1:nsup)
            ground(:6, :) = found(:, 1:nfound)
            ground(7, :) = iglaw(1:nfound)
            do k = 1, nfound
                ! Parameters that its law does not have may hold anything
                ground(8:13, k) = merge(glaw(:, k), 0.0_wp, [1, 2, 3, 1, 2, 3] <= parameters_of(iglaw(k)))
            end do
            if (present(shear)) ground(14, :) = shear(1:nfound)
            owners(:nprof) = iprof(1:nprof)
            owners(nprof + 1:) = itab(1, 1:ntab)
            points(:2, :nprof) = aprof(:, 1:nprof)
            points(3, :nprof) = gapbeam_table_of_gap
            points(:2, nprof + 1:) = atab(:, 1:ntab)
            points(3, nprof + 1:) = itab(2, 1:ntab)
            call model_from_arrays(spans, hinges, sections, codes, supports, ilaw(1:nlaw), alaw(:, 1:nlaw), iload(:, 1:nload), &
                                   aload(:, 1:nload), model, error)
        end if
        if (.not. allocated(error)) call foundations_from_arrays(ifound(1:nfound), ground, owners, points, iflaw(1:nflaw), &
                                                                 aflaw(:, 1:nflaw), model, error)
        if (.not. allocated(error)) then
            if (present(nmass)) model%masses = amass(:, 1:nmass)
            model%first_order = .true.
            if (present(igrow)) then
                model%N_grows = modulo(igrow, 2) /= 0
                model%first_order = modulo(igrow/2, 2) /= 0
                model%stretching = modulo(igrow/4, 2) /= 0
                model%with_trains = modulo(igrow/8, 2) /= 0
            end if
            call new_beam(model, handle, error)
        end if
        if (.not. allocated(error)) then
            beam = number_of(handle)
            return
        end if
        info = error%code
        ientry = error%entry
        if (error%code == gapbeam_bad_input) info = -argument_of(error, nprof)
    end subroutine prepare

    !> The argument of GHPRAF, or of GHPRSL and GHPRFR, that bad input is about
    pure function argument_of(error, nprof) result(place)
        type(error_type), intent(in) :: error
        !> Number of points of profiles
        integer, intent(in) :: nprof
        integer :: place
        !> The argument that an array of the model is; of a pair of arrays the first, which has the number of entries
        integer, parameter :: argument(0:6) = [1, 2, 4, 6, 9, 0, 16]

        place = argument(error%table)
        if (error%key == "masses") place = 33
        select case (error%table)
        case (of_spans)
            if (error%key == "N" .or. error%key == "mass") place = 29
        case (of_sections)
            place = 36
        case (of_supports)
            if (error%key == "law") place = 12
            if (index(error%key, "law.") == 1) place = 16
            if (error%key == "unloading") place = 14
            if (error%key == "friction") place = 17
        case (of_foundations)
            if (error%key == "law") place = merge(24, 22, error%reason == not_expected)
            if (index(error%key, "law.") == 1) place = 25
            if (error%key == "profile") place = 19
            ! A point of a table
            if (error%partner > 0 .and. (error%key == "k" .or. index(error%key, "law.") == 1)) place = 27
            if (error%key == "profile" .and. nprof == 0) place = 27
            if (error%key == "shear") place = 30
        case default
        end select
    end function argument_of

end module gapbeam_fortran77_model

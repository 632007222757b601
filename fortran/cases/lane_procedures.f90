!> The procedures that are compiled for one kind of processor, and for stiffnesses that all cases share or not.
module gapbeam_lane_procedures
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_lane_columns, only: take_columns, take_numbers, give_pack
    use gapbeam_lane_links, only: make_links
    use gapbeam_lane_search, only: search_pack
    use gapbeam_lane_finish, only: finish_pack
    use gapbeam_lane_audit, only: audit_pack
    use gapbeam_lane_extremes, only: extremes_of_pack
    use gapbeam_lane_values, only: fields_of_pack
    use gapbeam_lane_certificate, only: certify_pack
    use gapbeam_segment_finish, only: solve_long_beam, audit_long_beam
    implicit none
    private
    public :: compiled_here

contains

    !> The procedures compiled here
    function compiled_here() result(compiled)
        type(compiled_type) :: compiled

        compiled%take_columns => take_columns
        compiled%take_numbers => take_numbers
        compiled%give_pack => give_pack
        compiled%make_links => make_links
        compiled%search_pack => search_pack
        compiled%finish_pack => finish_pack
        compiled%audit_pack => audit_pack
        compiled%extremes_of_pack => extremes_of_pack
        compiled%fields_of_pack => fields_of_pack
        compiled%certify_pack => certify_pack
        compiled%solve_long_beam => solve_long_beam
        compiled%audit_long_beam => audit_long_beam
    end function compiled_here

end module gapbeam_lane_procedures

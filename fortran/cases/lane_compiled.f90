!> The procedures that work on eight cases, of one kind of processor: pointers to what is compiled for it.
module gapbeam_lane_compiled
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
    public :: compiled_type

    !> Named and with arguments as the procedures of the files lane_* and segment_finish
    type :: compiled_type
        procedure(take_columns), pointer, nopass :: take_columns => null()
        procedure(take_numbers), pointer, nopass :: take_numbers => null()
        procedure(give_pack), pointer, nopass :: give_pack => null()
        procedure(make_links), pointer, nopass :: make_links => null()
        procedure(search_pack), pointer, nopass :: search_pack => null()
        procedure(finish_pack), pointer, nopass :: finish_pack => null()
        procedure(audit_pack), pointer, nopass :: audit_pack => null()
        procedure(extremes_of_pack), pointer, nopass :: extremes_of_pack => null()
        procedure(fields_of_pack), pointer, nopass :: fields_of_pack => null()
        procedure(certify_pack), pointer, nopass :: certify_pack => null()
        procedure(solve_long_beam), pointer, nopass :: solve_long_beam => null()
        procedure(audit_long_beam), pointer, nopass :: audit_long_beam => null()
    end type compiled_type

end module gapbeam_lane_compiled

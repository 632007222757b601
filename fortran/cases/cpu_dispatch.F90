!> Dispatch of eight cases to the best instructions that the processor has.
!> Modules whose names end in _v3 and _v4 are the same sources compiled for AVX2 and for AVX-512 (x86-64-v3 and v4 of the psABI),
!> those with _own for stiffnesses that differ from case to case (gapbeam_lane_stiffness); all give the same digits
module gapbeam_cpu_dispatch
    use, intrinsic :: iso_c_binding, only: c_int
    use gapbeam_kinds, only: wp
    use gapbeam_quantities, only: bending_count
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_pieces_type, lane_rounding_type, pack_type, piece_pack_type, &
        lane_spans_type
    use gapbeam_lane_columns, only: take_columns, take_numbers, give_pack
    use gapbeam_lane_search, only: search_pack
    use gapbeam_lane_finish, only: finish_pack
    use gapbeam_lane_audit, only: audit_pack
    use gapbeam_lane_extremes, only: extremes_of_pack
    use gapbeam_lane_values, only: fields_of_pack
    use gapbeam_lane_certificate, only: certify_pack
    use gapbeam_segment_types, only: segment_beam_type, segment_room_type
    use gapbeam_segment_finish, only: solve_long_beam, audit_long_beam
    use gapbeam_lane_links, only: make_links
    use gapbeam_lane_search_own, only: search_pack_own => search_pack
    use gapbeam_lane_finish_own, only: finish_pack_own => finish_pack
    use gapbeam_lane_audit_own, only: audit_pack_own => audit_pack
    use gapbeam_lane_extremes_own, only: extremes_of_pack_own => extremes_of_pack
    use gapbeam_lane_values_own, only: fields_of_pack_own => fields_of_pack
#ifdef GAPBEAM_LEVELS
    use gapbeam_lane_columns_v3, only: take_columns_v3 => take_columns, take_numbers_v3 => take_numbers, give_pack_v3 => give_pack
    use gapbeam_lane_columns_v4, only: take_columns_v4 => take_columns, take_numbers_v4 => take_numbers, give_pack_v4 => give_pack
    use gapbeam_lane_links_v3, only: make_links_v3 => make_links
    use gapbeam_lane_links_v4, only: make_links_v4 => make_links
    use gapbeam_lane_search_v3, only: search_pack_v3 => search_pack
    use gapbeam_lane_finish_v3, only: finish_pack_v3 => finish_pack
    use gapbeam_lane_search_v4, only: search_pack_v4 => search_pack
    use gapbeam_lane_finish_v4, only: finish_pack_v4 => finish_pack
    use gapbeam_lane_audit_v3, only: audit_pack_v3 => audit_pack
    use gapbeam_lane_extremes_v3, only: extremes_of_pack_v3 => extremes_of_pack
    use gapbeam_lane_values_v3, only: fields_of_pack_v3 => fields_of_pack
    use gapbeam_lane_audit_v4, only: audit_pack_v4 => audit_pack
    use gapbeam_lane_extremes_v4, only: extremes_of_pack_v4 => extremes_of_pack
    use gapbeam_lane_values_v4, only: fields_of_pack_v4 => fields_of_pack
    use gapbeam_lane_certificate_v3, only: certify_pack_v3 => certify_pack
    use gapbeam_lane_certificate_v4, only: certify_pack_v4 => certify_pack
    use gapbeam_segment_finish_v3, only: solve_long_beam_v3 => solve_long_beam, audit_long_beam_v3 => audit_long_beam
    use gapbeam_segment_finish_v4, only: solve_long_beam_v4 => solve_long_beam, audit_long_beam_v4 => audit_long_beam
    use gapbeam_lane_search_own_v3, only: search_pack_own_v3 => search_pack
    use gapbeam_lane_finish_own_v3, only: finish_pack_own_v3 => finish_pack
    use gapbeam_lane_search_own_v4, only: search_pack_own_v4 => search_pack
    use gapbeam_lane_finish_own_v4, only: finish_pack_own_v4 => finish_pack
    use gapbeam_lane_audit_own_v3, only: audit_pack_own_v3 => audit_pack
    use gapbeam_lane_extremes_own_v3, only: extremes_of_pack_own_v3 => extremes_of_pack
    use gapbeam_lane_values_own_v3, only: fields_of_pack_own_v3 => fields_of_pack
    use gapbeam_lane_audit_own_v4, only: audit_pack_own_v4 => audit_pack
    use gapbeam_lane_extremes_own_v4, only: extremes_of_pack_own_v4 => extremes_of_pack
    use gapbeam_lane_values_own_v4, only: fields_of_pack_own_v4 => fields_of_pack
#endif
    implicit none
    private
    public :: best_level, least_level, take_columns_at, take_numbers_at, give_pack_at, search_pack_at, finish_pack_at, &
        audit_pack_at, extremes_of_pack_at, fields_of_pack_at, certify_pack_at, solve_segments_at, audit_segments_at, make_links_at

    !> Level of what every processor has
    integer, parameter :: least_level = 2
    !> Added to the level where stiffnesses differ from case to case
    integer, parameter :: own = 10

#ifdef GAPBEAM_LEVELS
    interface
        !> cases/processor.c
        pure function level_of_processor() result(level) bind(c, name="lanes_level_of_processor")
            import :: c_int
            implicit none
            integer(c_int) :: level
        end function level_of_processor
    end interface
#endif

contains

    !> The highest level at which this processor can compute
    pure function best_level() result(level)
        integer :: level

        level = least_level
#ifdef GAPBEAM_LEVELS
        level = level_of_processor()
#endif
    end function best_level

    !> take_columns at a level that the processor has
    subroutine take_columns_at(level, rows, cases, columns, numbers, to)
        !> From least_level to best_level()
        integer, intent(in) :: level
        !> As for take_columns
        integer, intent(in) :: rows, cases, numbers(lanes)
        real(wp), intent(in) :: columns(rows, cases)
        real(wp), intent(out) :: to(lanes, rows)

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call take_columns_v4(rows, cases, columns, numbers, to)
        case (3)
            call take_columns_v3(rows, cases, columns, numbers, to)
#endif
        case default
            call take_columns(rows, cases, columns, numbers, to)
        end select
    end subroutine take_columns_at

    !> take_numbers likewise
    subroutine take_numbers_at(level, beam, units, values, numbers, turned, pack, lost)
        integer, intent(in) :: level
        !> As for take_numbers
        type(lane_beam_type), intent(in) :: beam
        real(wp), intent(in) :: units(2)
        real(wp), intent(in), contiguous :: values(:, :, :)
        integer, intent(in) :: numbers(lanes)
        real(wp), intent(inout), contiguous :: turned(:, :)
        type(pack_type), intent(inout) :: pack
        logical, intent(out) :: lost

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call take_numbers_v4(beam, units, values, numbers, turned, pack, lost)
        case (3)
            call take_numbers_v3(beam, units, values, numbers, turned, pack, lost)
#endif
        case default
            call take_numbers(beam, units, values, numbers, turned, pack, lost)
        end select
    end subroutine take_numbers_at

    !> give_pack likewise
    subroutine give_pack_at(level, beam, units, pack, numbers, turned, closed, w, ml, mr, reaction)
        integer, intent(in) :: level
        !> As for give_pack
        type(lane_beam_type), intent(in) :: beam
        real(wp), intent(in) :: units(3)
        type(pack_type), intent(in) :: pack
        integer, intent(in) :: numbers(lanes)
        real(wp), intent(inout), contiguous :: turned(:, :)
        integer, intent(inout), contiguous :: closed(:, :)
        real(wp), intent(inout), contiguous :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call give_pack_v4(beam, units, pack, numbers, turned, closed, w, ml, mr, reaction)
        case (3)
            call give_pack_v3(beam, units, pack, numbers, turned, closed, w, ml, mr, reaction)
#endif
        case default
            call give_pack(beam, units, pack, numbers, turned, closed, w, ml, mr, reaction)
        end select
    end subroutine give_pack_at

    !> search_pack likewise
    subroutine search_pack_at(level, beam, factors, pack, solves, method)
        integer, intent(in) :: level
        !> As for search_pack
        type(lane_beam_type), intent(in) :: beam
        real(wp), intent(in), contiguous :: factors(:, :)
        type(pack_type), intent(inout) :: pack
        integer, intent(out) :: solves(lanes), method(lanes)

        select case (level + merge(own, 0, size(beam%links, 1) > 1))
#ifdef GAPBEAM_LEVELS
        case (4)
            call search_pack_v4(beam, factors, pack, solves, method)
        case (3)
            call search_pack_v3(beam, factors, pack, solves, method)
        case (own + 4)
            call search_pack_own_v4(beam, factors, pack, solves, method)
        case (own + 3)
            call search_pack_own_v3(beam, factors, pack, solves, method)
#endif
        case (own + least_level)
            call search_pack_own(beam, factors, pack, solves, method)
        case default
            call search_pack(beam, factors, pack, solves, method)
        end select
    end subroutine search_pack_at

    !> finish_pack likewise
    subroutine finish_pack_at(level, beam, method, pack, doubtful)
        integer, intent(in) :: level
        !> As for finish_pack
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: method
        type(pack_type), intent(inout) :: pack
        logical, intent(out) :: doubtful(lanes)

        select case (level + merge(own, 0, size(beam%links, 1) > 1))
#ifdef GAPBEAM_LEVELS
        case (4)
            call finish_pack_v4(beam, method, pack, doubtful)
        case (3)
            call finish_pack_v3(beam, method, pack, doubtful)
        case (own + 4)
            call finish_pack_own_v4(beam, method, pack, doubtful)
        case (own + 3)
            call finish_pack_own_v3(beam, method, pack, doubtful)
#endif
        case (own + least_level)
            call finish_pack_own(beam, method, pack, doubtful)
        case default
            call finish_pack(beam, method, pack, doubtful)
        end select
    end subroutine finish_pack_at

    !> audit_pack likewise
    subroutine audit_pack_at(level, beam, pack, wrong)
        integer, intent(in) :: level
        !> As for audit_pack
        type(lane_beam_type), intent(in) :: beam
        type(pack_type), intent(inout) :: pack
        !> In which cases the numbers are no solution
        logical, intent(out) :: wrong(lanes)

        select case (level + merge(own, 0, size(beam%links, 1) > 1))
#ifdef GAPBEAM_LEVELS
        case (4)
            call audit_pack_v4(beam, pack, wrong)
        case (3)
            call audit_pack_v3(beam, pack, wrong)
        case (own + 4)
            call audit_pack_own_v4(beam, pack, wrong)
        case (own + 3)
            call audit_pack_own_v3(beam, pack, wrong)
#endif
        case (own + least_level)
            call audit_pack_own(beam, pack, wrong)
        case default
            call audit_pack(beam, pack, wrong)
        end select
    end subroutine audit_pack_at

    !> extremes_of_pack likewise
    subroutine extremes_of_pack_at(level, beam, pieces, wanted, factors, pack, fields, extremes, poor)
        integer, intent(in) :: level
        !> As for extremes_of_pack
        type(lane_beam_type), intent(in) :: beam
        type(lane_pieces_type), intent(in) :: pieces
        logical, intent(in) :: wanted(bending_count)
        real(wp), intent(in), contiguous :: factors(:, :)
        type(pack_type), intent(inout) :: pack
        type(piece_pack_type), intent(inout) :: fields
        real(wp), intent(inout) :: extremes(lanes, 6, bending_count)
        real(wp), intent(out) :: poor(lanes)

        select case (level + merge(own, 0, size(beam%links, 1) > 1))
#ifdef GAPBEAM_LEVELS
        case (4)
            call extremes_of_pack_v4(beam, pieces, wanted, factors, pack, fields, extremes, poor)
        case (3)
            call extremes_of_pack_v3(beam, pieces, wanted, factors, pack, fields, extremes, poor)
        case (own + 4)
            call extremes_of_pack_own_v4(beam, pieces, wanted, factors, pack, fields, extremes, poor)
        case (own + 3)
            call extremes_of_pack_own_v3(beam, pieces, wanted, factors, pack, fields, extremes, poor)
#endif
        case (own + least_level)
            call extremes_of_pack_own(beam, pieces, wanted, factors, pack, fields, extremes, poor)
        case default
            call extremes_of_pack(beam, pieces, wanted, factors, pack, fields, extremes, poor)
        end select
    end subroutine extremes_of_pack_at

    !> fields_of_pack likewise
    subroutine fields_of_pack_at(level, beam, pieces, factors, pack, fields, piece, distance, values, poor)
        integer, intent(in) :: level
        !> As for fields_of_pack
        type(lane_beam_type), intent(in) :: beam
        type(lane_pieces_type), intent(in) :: pieces
        real(wp), intent(in), contiguous :: factors(:, :)
        type(pack_type), intent(inout) :: pack
        type(piece_pack_type), intent(inout) :: fields
        integer, intent(in), contiguous :: piece(:)
        real(wp), intent(in), contiguous :: distance(:)
        real(wp), intent(out) :: values(lanes, size(piece), bending_count)
        real(wp), intent(out) :: poor(lanes)

        select case (level + merge(own, 0, size(beam%links, 1) > 1))
#ifdef GAPBEAM_LEVELS
        case (4)
            call fields_of_pack_v4(beam, pieces, factors, pack, fields, piece, distance, values, poor)
        case (3)
            call fields_of_pack_v3(beam, pieces, factors, pack, fields, piece, distance, values, poor)
        case (own + 4)
            call fields_of_pack_own_v4(beam, pieces, factors, pack, fields, piece, distance, values, poor)
        case (own + 3)
            call fields_of_pack_own_v3(beam, pieces, factors, pack, fields, piece, distance, values, poor)
#endif
        case (own + least_level)
            call fields_of_pack_own(beam, pieces, factors, pack, fields, piece, distance, values, poor)
        case default
            call fields_of_pack(beam, pieces, factors, pack, fields, piece, distance, values, poor)
        end select
    end subroutine fields_of_pack_at

    !> certify_pack likewise
    subroutine certify_pack_at(level, beam, rounding, factors, pack, moves, found, poor)
        integer, intent(in) :: level
        !> As for certify_pack
        type(lane_beam_type), intent(in) :: beam
        type(lane_rounding_type), intent(in) :: rounding
        real(wp), intent(in), contiguous :: factors(:, :)
        type(pack_type), intent(inout) :: pack
        real(wp), intent(inout), contiguous :: moves(:, 0:, :)
        real(wp), intent(out) :: found(lanes, 9), poor(lanes)

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call certify_pack_v4(beam, rounding, factors, pack, moves, found, poor)
        case (3)
            call certify_pack_v3(beam, rounding, factors, pack, moves, found, poor)
#endif
        case default
            call certify_pack(beam, rounding, factors, pack, moves, found, poor)
        end select
    end subroutine certify_pack_at

    !> solve_long_beam likewise
    subroutine solve_segments_at(level, beam, room, solves, doubtful)
        integer, intent(in) :: level
        !> As for solve_long_beam
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(inout) :: room
        integer, intent(out) :: solves
        logical, intent(out) :: doubtful

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call solve_long_beam_v4(beam, room, solves, doubtful)
        case (3)
            call solve_long_beam_v3(beam, room, solves, doubtful)
#endif
        case default
            call solve_long_beam(beam, room, solves, doubtful)
        end select
    end subroutine solve_segments_at

    !> audit_long_beam likewise
    subroutine audit_segments_at(level, beam, room, wrong)
        integer, intent(in) :: level
        !> As for audit_long_beam
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(in) :: room
        logical, intent(out) :: wrong

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call audit_long_beam_v4(beam, room, wrong)
        case (3)
            call audit_long_beam_v3(beam, room, wrong)
#endif
        case default
            call audit_long_beam(beam, room, wrong)
        end select
    end subroutine audit_segments_at

    !> make_links likewise
    pure subroutine make_links_at(level, spans, length, stiffness, flexibility, shear_flexibility, links, to_link)
        integer, intent(in) :: level
        !> As for make_links
        type(lane_spans_type), intent(in) :: spans
        real(wp), intent(in), contiguous :: length(:), stiffness(:, :, :)
        real(wp), intent(inout), contiguous :: flexibility(:, :), shear_flexibility(:, :), links(:, :, :), to_link(:, :, :)

        select case (level)
#ifdef GAPBEAM_LEVELS
        case (4)
            call make_links_v4(spans, length, stiffness, flexibility, shear_flexibility, links, to_link)
        case (3)
            call make_links_v3(spans, length, stiffness, flexibility, shear_flexibility, links, to_link)
#endif
        case default
            call make_links(spans, length, stiffness, flexibility, shear_flexibility, links, to_link)
        end select
    end subroutine make_links_at

end module gapbeam_cpu_dispatch

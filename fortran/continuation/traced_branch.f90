!> Ways on from a bifurcation on smooth laws: on their polylines chance decides whether stable ones go on there.
module gapbeam_traced_branch
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_smooth_arc, only: arc_type, is_lost
    use gapbeam_smooth_branches, only: branch_points_type, tracer_at, follow_branch
    use gapbeam_history_stretch, only: stretch_type, nothing_changes
    use gapbeam_history_record, only: limit_type, add_stretch, no_limit, limit_point, bifurcation, ended
    use gapbeam_path_on_laws, only: view_type, goal_of_leg, way_of_leg, given_factor, unknown, start_of_stretch, stop_of_stretch
    implicit none
    private
    public :: branch_off

contains

    !> Go on from the end of a stretch, where the path branches on the laws
    subroutine branch_off(view, k, arc, error)
        type(view_type), intent(inout) :: view
        !> The stretch, whose end is known; where it is not stable nothing is done
        integer, intent(in) :: k
        !> On which its end was found
        type(arc_type), intent(in), target :: arc
        !> How the path goes on cannot be told
        type(error_type), allocatable, intent(out) :: error
        type(branch_points_type) :: branch
        real(wp), allocatable :: origin(:)
        logical :: stays, is_limit, is_last
        real(wp) :: goal

        associate (h => view%history, s => view%history%stretches(k))
            goal = goal_of_leg(view, s%leg)
            if (s%index /= 0 .or. s%leg == 0 .or. s%direction /= way_of_leg(view, s%leg, goal)) return
            is_last = s%leg == h%stretches(h%number)%leg
            allocate (origin, source=[h%on_laws%ends(stop_of_stretch, k)%x, s%to])
            call follow_branch(tracer_at(arc, origin), s%direction, merge(view%target, goal, is_last), branch, error)
            if (is_lost(error)) then
                deallocate (error)
                return
            end if
            if (allocated(error)) return
            stays = branch%number == 1  ! no way on is stable
            is_limit = any(h%limits%stretch == k)
            if (stays .and. is_limit) return
            if (.not. view%stops .or. branch%lost .or. (branch%arrives .and. .not. is_last)) then
                if (stays .or. is_limit .or. branch%lost) then
                    call fatal_error(error, gapbeam_not_converged, "at load factor "//trim(shown(s%to))//" equal smooth laws "// &
                                     "soften together, and how the path continues from there cannot be followed on them: use "// &
                                     'at_limit = "stop" without further load factors, or make one of them differ a little')
                end if
                return
            end if
        end associate
        call take_branch(view, k, arc, branch, error)
    end subroutine branch_off

    !> End the path with the branch instead of what is beyond the bifurcation on the polylines
    subroutine take_branch(view, k, arc, branch, error)
        type(view_type), intent(inout) :: view
        integer, intent(in) :: k
        type(arc_type), intent(in) :: arc
        type(branch_points_type), intent(in) :: branch
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: stretch
        real(wp) :: last
        integer :: i, n

        n = size(branch%points, 1) - 1
        last = branch%points(n + 1, branch%number)
        associate (h => view%history, known => view%history%on_laws)
            stretch = h%stretches(k)
            call nothing_changes(stretch)
            stretch%index = 0
            stretch%ways = 2
            stretch%skipped = .false.
            stretch%from = stretch%to
            stretch%to = last
            h%limits = pack(h%limits, h%limits%stretch < k)
            h%others = pack_others(h%others, k)
            h%number = k
            known%traced = k + 1
            known%branch = branch%points(:, :branch%number)
            known%arc = arc
            known%arc%number = 0
            known%joins = known%joins(:k)
            if (branch%number > 1) then
                call add_stretch(stretch, h, error)
                if (allocated(error)) return
                known%joins = [known%joins, merge(given_factor, unknown, branch%arrives)]
                if (size(known%ends, 2) == k) call make_room()
                known%ends(start_of_stretch, k + 1)%x = branch%points(:n, 1)
                known%ends(stop_of_stretch, k + 1)%x = branch%points(:n, branch%number)
                known%rough(:, k + 1) = [h%stretches(k + 1)%from, last]
                known%lands(k + 1:) = .false.
            end if
            if (.not. branch%arrives) then
                h%limits = [h%limits, limit_type(merge(bifurcation, limit_point, branch%number == 1), h%stretches(k)%leg, last, &
                                                 h%number, 0)]
            end if
            h%ending = merge(no_limit, ended, branch%arrives)
            if (allocated(h%motion)) deallocate (h%motion)
        end associate

    contains

        !> Room for the ends of one stretch more
        subroutine make_room()
            associate (known => view%history%on_laws)
                known%lands = [known%lands, .false.]
                known%rough = reshape([known%rough, 0.0_wp, 0.0_wp], [2, k + 1])
                known%ends = reshape([(known%ends(:, i), i=1, k), known%ends(:, k)], [2, k + 1])
            end associate
        end subroutine make_room

        !> Ways that were not taken up to the bifurcation
        pure function pack_others(others, most) result(kept)
            use gapbeam_history_record, only: other_way_type
            type(other_way_type), intent(in) :: others(:)
            integer, intent(in) :: most
            type(other_way_type), allocatable :: kept(:)
            integer :: j

            kept = others(pack([(j, j=1, size(others))], others%stretch <= most))
        end function pack_others

    end subroutine take_branch

end module gapbeam_traced_branch

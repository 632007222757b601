!> Start of a solve on the ground from the solution at a load factor nearby.
module gapbeam_ground_start
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: rough
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, new_zones
    use gapbeam_workspace, only: workspace_type
    use gapbeam_zones, only: settle_zones, polish_zones
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_ground_solution, only: ground_solution_type
    implicit none
    private
    public :: ground_start_type, start_from, settle_nearby, polish_nearby, take_zones

    !> Where the search for a solution may begin: zones and states of the supports at a load factor nearby, and that
    type :: ground_start_type
        type(zones_type) :: zones
        logical, allocatable :: closed(:)
        real(wp) :: factor = 0.0_wp
    end type ground_start_type

contains

    !> Begin where a beam was solved
    pure subroutine start_from(solution, closed, start)
        !> The solution, and the states of its supports
        type(ground_solution_type), intent(in) :: solution
        logical, intent(in) :: closed(:)
        type(ground_start_type), intent(out) :: start
        integer :: i

        allocate (start%closed, source=closed)
        start%factor = solution%factor
        call new_zones(size(solution%piece), size(solution%acts, 1), solution%steps, start%zones)
        start%zones%piece(:) = solution%piece
        start%zones%from(:) = solution%from
        start%zones%to(:) = solution%to
        start%zones%acts(:, :) = solution%acts
        if (allocated(solution%pushing)) allocate (start%zones%pushed(0:size(solution%piece)), source=solution%pushing > 0)
        do i = 1, size(solution%piece)
            associate (ends => solution%ends(i), stretch => solution%stretches(i))
                start%zones%start(:, i) = [ends%w_a - stretch%shear_flexibility*ends%moment_a, solution%rotation(1, i), &
                                           ends%moment_a, solution%shear(1, i)]
            end associate
        end do
    end subroutine start_from

    !> Settle zones and supports in double precision from those at another load factor
    subroutine settle_nearby(ground, factor, rule, start, grounded, work, solves, settled, solved)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        !> Load factor, and rule for the supports
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Where to begin in; zones and supports there out
        type(ground_start_type), intent(inout) :: start
        !> The beam on its zones, and its solution
        type(grounded_type), intent(out) :: grounded
        type(workspace_type), intent(out) :: work
        !> Linear solves so far
        integer, intent(inout) :: solves
        !> Are the zones right; have they a solution at least, which is off by the square of what their ends are
        logical, intent(out) :: settled, solved
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: moving
        real(wp) :: moved

        call settle_zones(ground, factor, rule, rough, start%zones, start%closed, grounded, work, outcome, settled, moved, error)
        solves = solves + work%solves
        solved = .not. allocated(error) .and. outcome%status == gapbeam_solved
        settled = settled .and. solved
        start%factor = factor
        if (settled .or. .not. solved) return
        call polish_zones(ground, factor, rule, huge(1.0_wp), start%zones, start%closed, grounded, work, outcome, moving, error)
        solves = solves + work%solves
        solved = .not. allocated(error) .and. outcome%status == gapbeam_solved
    end subroutine settle_nearby

    !> The same with no other zones than those, but for their ends, if that can be
    subroutine polish_nearby(ground, factor, rule, start, solves, solved)
        !> As for settle_nearby
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        type(ground_start_type), intent(inout) :: start
        integer, intent(inout) :: solves
        logical, intent(out) :: solved
        type(ground_start_type) :: polished
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: settled

        polished = start
        call polish_zones(ground, factor, rule, rough, polished%zones, polished%closed, grounded, work, outcome, settled, error)
        solves = solves + work%solves
        solved = settled .and. .not. allocated(error)
        if (solved) then
            start = polished
            start%factor = factor
        else
            call settle_nearby(ground, factor, rule, start, grounded, work, solves, settled, solved)
        end if
    end subroutine polish_nearby

    !> A solution of which only the zones are known
    pure subroutine take_zones(zones, solution)
        type(zones_type), intent(in) :: zones
        type(ground_solution_type), intent(out) :: solution

        allocate (solution%piece, source=zones%piece)
        allocate (solution%from, source=zones%from)
        allocate (solution%to, source=zones%to)
        allocate (solution%acts, source=zones%acts)
    end subroutine take_zones

end module gapbeam_ground_start

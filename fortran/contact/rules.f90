!> Which supports are wrong in a scheme, and which of them a rule changes
module gapbeam_rules
    use gapbeam_kinds, only: wp
    use gapbeam_model, only: beam_type, both, is_rigid
    use gapbeam_workspace, only: workspace_type
    use gapbeam_reactions, only: find_own_sizes
    implicit none
    private
    public :: find_wrong, find_clearly_wrong, find_doubtful, margin_of, complementarity
    public :: keep_worst_pull, keep_local_worst, keep_least_index, separate_rigid_pairs, first_width

    !> Rounding errors beyond which a sign counts
    real(wp), parameter :: first_width = 32.0_wp
    !> Far above all rounding errors
    real(wp), parameter :: near_zero = 2.0_wp**19*epsilon(1.0_wp)

contains

    !> Which supports have the wrong state
    pure subroutine find_wrong(beam, closed, width, work, wrong)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Rounding errors beyond which a sign counts
        real(wp), intent(in) :: width
        type(workspace_type), intent(in) :: work
        logical, intent(out) :: wrong(:)
        real(wp) :: margin, rounding
        integer :: k

        do k = 1, size(closed)
            call margin_of(beam, closed(k), k, work, margin, rounding)
            wrong(k) = margin < -width*rounding
        end do
    end subroutine find_wrong

    !> Of which supports the sign cannot be told from zero, so that their state may be either
    pure subroutine find_doubtful(beam, closed, work, doubtful, in_doubt)
        !> The beam, its scheme, and the workspace with its solution
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> Shape (size(closed))
        logical, intent(out) :: doubtful(:)
        !> Is any of them not exactly zero
        logical, intent(out), optional :: in_doubt
        real(wp) :: margin, rounding
        integer :: k

        if (present(in_doubt)) in_doubt = .false.
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                doubtful(k) = .false.
                if (s%side == both .or. .not. s%stiffness > 0.0_wp) cycle
                call margin_of(beam, closed(k), k, work, margin, rounding)
                doubtful(k) = abs(margin) <= first_width*rounding
                if (present(in_doubt)) in_doubt = in_doubt .or. (doubtful(k) .and. rounding > 0.0_wp)
            end associate
        end do
    end subroutine find_doubtful

    !> By how much the state of a support is right, and the rounding error of that: the one measure of all signs
    pure subroutine margin_of(beam, closed, k, work, margin, rounding)
        type(beam_type), intent(in) :: beam
        !> Does the support act, and its number
        logical, intent(in) :: closed
        integer, intent(in) :: k
        type(workspace_type), intent(in) :: work
        !> Force with which it pushes, or distance to contact; 0 for supports whose state does not change
        real(wp), intent(out) :: margin
        real(wp), intent(out) :: rounding

        margin = 0.0_wp
        rounding = 0.0_wp
        associate (s => beam%supports(k), w => work%answers(beam%supports(k)%node)%deflection)
            if (s%side == both .or. .not. s%stiffness > 0.0_wp) return
            if (closed) then
                margin = s%side*work%reaction(k)
                rounding = work%reaction_error(k)
            else
                margin = s%side*(s%contact - w)
                rounding = epsilon(w)*max(work%deflection_size(s%node), abs(s%contact))
            end if
        end associate
    end subroutine margin_of

    !> The same from deflections and moments alone, as long as nothing is near zero
    pure subroutine find_clearly_wrong(beam, closed, work, wrong, doubtful)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Solved by solve_deflections
        type(workspace_type), intent(inout) :: work
        logical, intent(out) :: wrong(:)
        !> Something is so near zero that only find_wrong can tell
        logical, intent(out) :: doubtful
        real(wp) :: largest_shear, largest_deflection, pressing, force
        integer :: i, k, n

        n = size(beam%links)
        doubtful = .false.
        ! No rounding error that find_wrong allows for can be larger than these times some epsilon
        call find_own_sizes(beam, [0, n], work)
        largest_shear = near_zero*maxval(work%reach_own%shear)
        largest_deflection = near_zero*maxval(work%reach_own%deflection)
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                wrong(k) = .false.
                if (s%side == both .or. .not. s%stiffness > 0.0_wp) cycle
                i = s%node
                if (closed(k) .and. is_rigid(s)) then
                    force = work%loads(i)%shear + work%ease(i)*(work%reference(i) - work%answers(i)%deflection)
                    if (i > 0) force = force - (work%answers(i)%moment_left - work%answers(i - 1)%moment_right) &
                        *beam%links(i)%inverse
                    if (i < n) force = force + (work%answers(i + 1)%moment_left - work%answers(i)%moment_right) &
                        *beam%links(i + 1)%inverse
                    if (abs(force) <= largest_shear .or. beam%first(i + 1) - beam%first(i) > 1) doubtful = .true.
                    wrong(k) = s%side*force < 0.0_wp
                else
                    pressing = s%side*(work%answers(i)%deflection - s%contact)
                    if (abs(pressing) <= largest_deflection + near_zero*abs(s%contact)) doubtful = .true.
                    wrong(k) = closed(k) .neqv. pressing > 0.0_wp
                end if
                if (doubtful) return
            end associate
        end do
    end subroutine find_clearly_wrong

    !> Largest wrong-signed reaction relative to the largest reaction, or penetration relative to the largest deflection
    pure function complementarity(beam, closed, work) result(violation)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        real(wp) :: violation, largest_reaction, largest_deflection
        integer :: k

        violation = 0.0_wp
        if (size(closed) == 0) return
        largest_reaction = max(maxval(abs(work%reaction)), tiny(violation))
        largest_deflection = max(maxval(abs(work%answers%deflection)), tiny(violation))
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                if (s%side == both) cycle
                if (closed(k)) then
                    violation = max(violation, -s%side*work%reaction(k)/largest_reaction)
                else if (s%stiffness > 0.0_wp) then
                    violation = max(violation, s%side*(work%answers(s%node)%deflection - s%contact)/largest_deflection)
                end if
            end associate
        end do
    end function complementarity

    !> The paper's rule (section 3): of the closed supports that pull release the one that pulls most, and put back every
    !> open one that is penetrated
    pure subroutine keep_worst_pull(closed, work, wrong)
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> All wrong supports in, those to be changed out
        logical, intent(inout) :: wrong(:)
        integer :: worst

        if (.not. any(wrong .and. closed)) return
        worst = maxloc(abs(work%reaction), 1, wrong .and. closed)
        wrong = wrong .and. .not. closed
        wrong(worst) = .true.
    end subroutine keep_worst_pull

    !> One change in every neighbourhood. Put back first: of neighbouring open supports the most penetrated one. Release only
    !> where no open stretch beside waits for a support to be put back: of neighbouring closed supports the one that pulls
    !> most
    pure subroutine keep_local_worst(beam, closed, work, wrong)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> All wrong supports in, those to be changed out
        logical, intent(inout) :: wrong(:)
        logical, allocatable :: waits(:)
        real(wp), allocatable :: badness(:)
        integer :: n, first, last, k

        n = size(closed)
        allocate (waits(0:n + 1), badness(size(closed)))
        waits = .false.
        do k = 1, n
            associate (s => beam%supports(k))
                badness(k) = abs(merge(work%reaction(k), work%answers(s%node)%deflection - s%contact, closed(k)))
            end associate
        end do
        last = 0
        do while (last < n)
            first = last + 1
            last = end_of_run(closed, beam%order, first)
            if (closed(beam%order(first))) cycle
            waits(first:last) = any(wrong(beam%order(first:last)))
            call keep_one(beam%order(first:last), badness, wrong)
        end do
        last = 0
        do while (last < n)
            first = last + 1
            last = end_of_run(closed, beam%order, first)
            if (.not. closed(beam%order(first))) cycle
            if (waits(first - 1) .or. waits(last + 1)) then
                wrong(beam%order(first:last)) = .false.
            else
                call keep_one_of_each(beam%order(first:last), badness, wrong)
            end if
        end do
    end subroutine keep_local_worst

    !> End of the run of supports with the same state
    pure function end_of_run(state, order, first) result(last)
        logical, intent(in) :: state(:)
        integer, intent(in) :: order(:)
        integer, intent(in) :: first
        integer :: last

        last = first
        do while (last < size(order))
            if (state(order(last + 1)) .neqv. state(order(first))) exit
            last = last + 1
        end do
    end function end_of_run

    !> Of the wrong supports of a run keep the worst
    pure subroutine keep_one(run, badness, wrong)
        integer, intent(in) :: run(:)
        real(wp), intent(in) :: badness(:)
        logical, intent(inout) :: wrong(:)
        integer :: worst

        if (.not. any(wrong(run))) return
        worst = run(maxloc(badness(run), 1, wrong(run)))
        wrong(run) = .false.
        wrong(worst) = .true.
    end subroutine keep_one

    !> Of every group of neighbouring wrong supports in a run keep the worst
    pure subroutine keep_one_of_each(run, badness, wrong)
        integer, intent(in) :: run(:)
        real(wp), intent(in) :: badness(:)
        logical, intent(inout) :: wrong(:)
        logical, allocatable :: before(:)
        integer :: first, last

        allocate (before(size(wrong)))
        before(:) = wrong
        last = 0
        do while (last < size(run))
            first = last + 1
            last = end_of_run(before, run, first)
            if (before(run(first))) call keep_one(run(first:last), badness, wrong)
        end do
    end subroutine keep_one_of_each

    !> Murty's rule
    pure subroutine keep_least_index(wrong)
        logical, intent(inout) :: wrong(:)
        integer :: first

        first = findloc(wrong, .true., 1)
        wrong(first + 1:) = .false.
    end subroutine keep_least_index

    !> Two rigid supports at one node cannot both act: begin with the one that holds both ways, or with the first
    pure subroutine separate_rigid_pairs(beam, closed)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        logical, allocatable :: taken(:)
        integer :: k

        allocate (taken(0:size(beam%links)))
        taken = .false.
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                if (s%side == both .and. is_rigid(s)) taken(s%node) = .true.
            end associate
        end do
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                if (s%side == both .or. .not. closed(k) .or. .not. is_rigid(s)) cycle
                closed(k) = .not. taken(s%node)
                taken(s%node) = .true.
            end associate
        end do
    end subroutine separate_rigid_pairs

end module gapbeam_rules

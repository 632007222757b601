!> Wrong supports of a contact state, those that a rule changes, and cycles of states.
module gapbeam_rules
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: sign_width
    use gapbeam_law_margins, only: find_margins, find_wrong_states, find_doubtful_states
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type
    implicit none
    private
    public :: find_wrong, find_doubtful
    public :: keep_worst_pull, keep_local_worst, keep_least_index
    public :: mark_type, set_mark, cycled

    !> A scheme to compare later ones with
    type :: mark_type
        logical, allocatable :: closed(:)
        !> Schemes seen since it was set, and how many until it is moved
        integer :: since = 0, next = 1
    end type mark_type

contains

    !> Which supports have the wrong state
    pure subroutine find_wrong(beam, closed, width, work, wrong)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Rounding errors beyond which a sign counts
        real(wp), intent(in) :: width
        type(workspace_type), intent(in) :: work
        logical, intent(out) :: wrong(:)

        call find_wrong_states(beam%supports, closed, work%answers, work%deflection_size, work%reaction, work%reaction_error, &
                               width, wrong)
    end subroutine find_wrong

    !> Of which supports the sign cannot be told from zero, so that their state may be either
    pure subroutine find_doubtful(beam, closed, work, doubtful, in_doubt)
        !> The beam, its scheme, and the workspace with its solution
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> Shape (size(closed))
        logical, intent(out) :: doubtful(:)
        !> Is any of them not exactly zero, or is another one wrong
        logical, intent(out), optional :: in_doubt
        logical :: not_zero

        call find_doubtful_states(beam%supports, closed, work%answers, work%deflection_size, work%reaction, &
                                  work%reaction_error, sign_width, doubtful, not_zero)
        if (present(in_doubt)) in_doubt = not_zero
    end subroutine find_doubtful

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
        real(wp), allocatable :: badness(:), rounding(:)
        integer :: n, first, last

        n = size(closed)
        allocate (waits(0:n + 1), badness(n), rounding(n))
        waits = .false.
        call find_margins(beam%supports, closed, work%answers, work%deflection_size, work%reaction, work%reaction_error, &
                          badness, rounding)
        badness(:) = abs(badness)
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
        integer, intent(in) :: order(:), first
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

        allocate (before, source=wrong)
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

    !> Begin to watch for a scheme that comes back
    pure subroutine set_mark(mark, closed)
        type(mark_type), intent(out) :: mark
        logical, intent(in) :: closed(:)

        allocate (mark%closed, source=closed)
    end subroutine set_mark

    !> Is this scheme the marked one? The mark is moved here after 1, 2, 4, ... schemes (Brent 1980), so every cycle is found
    function cycled(mark, closed) result(again)
        type(mark_type), intent(inout) :: mark
        logical, intent(in) :: closed(:)
        logical :: again

        again = all(closed .eqv. mark%closed)
        mark%since = mark%since + 1
        if (mark%since < mark%next) return
        mark%closed(:) = closed
        mark%since = 0
        mark%next = 2*mark%next
    end function cycled

end module gapbeam_rules

!> Zones of contact and free spans of a beam on the ground, in the user's units.
module gapbeam_ground_zones
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: refuse_range, named, of_foundations
    use gapbeam_scene, only: gapbeam_both
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_runs, only: run_type, ground_runs
    use gapbeam_pieces, only: gapbeam_closed, gapbeam_bilateral, gapbeam_touching, gapbeam_branch
    implicit none
    private
    public :: contact_type, free_span_type, find_contact, find_free_spans

    !> A zone in which a foundation acts, or a place at which rigid ground pushes with a point force
    type :: contact_type
        !> Number of the foundation in the model, from 1
        integer :: foundation
        !> Its ends, from the left end of the beam
        real(wp) :: from, to
        !> gapbeam_closed, gapbeam_bilateral, gapbeam_branch plus the number of the piece of its law; gapbeam_touching: at one place
        !> only
        integer :: condition
        !> Force on the beam, up
        real(wp) :: resultant
    end type contact_type

    !> A stretch in which the beam does not touch a one-sided foundation that is there
    type :: free_span_type
        !> Number of the foundation in the model, from 1
        integer :: foundation
        !> Its ends, from the left end of the beam
        real(wp) :: from, to
        !> Largest distance between beam and ground
        real(wp) :: sag
    end type free_span_type

contains

    !> Zones in which the ground acts
    subroutine find_contact(assembled, solution, zones, error)
        !> The beam, and its solution on the ground
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Foundation by foundation from left to right
        type(contact_type), allocatable, intent(out) :: zones(:)
        !> A force out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(run_type), allocatable :: runs(:)
        integer :: i, n, stat

        call ground_runs(assembled, solution, runs, error)
        if (allocated(error)) return
        allocate (zones(count(runs%acts > 0 .or. runs%touches)), stat=stat)
        if (failed(stat, error)) return
        n = 0
        do i = 1, size(runs)
            associate (run => runs(i))
                if (run%acts == 0 .and. .not. run%touches) cycle
                if (.not. abs(run%resultant) <= huge(run%resultant)) then
                    call refuse_run(assembled, run, "the force", "force", error)
                    return
                end if
                n = n + 1
                zones(n) = contact_type(run%foundation, run%from, run%to, condition_of(run), run%resultant)
                if (.not. run%touches) cycle
                zones(n)%from = run%from + (run%to - run%from)/2
                zones(n)%to = zones(n)%from
                zones(n)%resultant = 0.0_wp
            end associate
        end do
    end subroutine find_contact

    !> What a layer in contact does, as a code
    pure function condition_of(run) result(condition)
        type(run_type), intent(in) :: run
        integer :: condition

        if (run%touches) then
            condition = gapbeam_touching
        else if (run%law_pieces > 0) then
            condition = gapbeam_branch + run%acts
        else
            condition = merge(gapbeam_bilateral, gapbeam_closed, run%side == gapbeam_both)
        end if
    end function condition_of

    !> Stretches in which the beam has no contact with one-sided ground
    subroutine find_free_spans(assembled, solution, spans, error)
        !> As for find_contact
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Foundation by foundation from left to right; of one that holds both ways there are none
        type(free_span_type), allocatable, intent(out) :: spans(:)
        !> A distance out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(run_type), allocatable :: runs(:)
        logical, allocatable :: free(:)
        integer :: i, n, stat

        call ground_runs(assembled, solution, runs, error)
        if (allocated(error)) return
        allocate (free(size(runs)), stat=stat)
        if (stat == 0) then
            free(:) = runs%acts == 0 .and. .not. runs%touches &
                .and. assembled%model%foundations(runs%foundation)%side /= gapbeam_both
            allocate (spans(count(free)), stat=stat)
        end if
        if (failed(stat, error)) return
        n = 0
        do i = 1, size(runs)
            if (.not. free(i)) cycle
            associate (run => runs(i))
                if (.not. run%way <= huge(run%way)) then
                    call refuse_run(assembled, run, "the distance to the ground", "length", error)
                    return
                end if
                n = n + 1
                spans(n) = free_span_type(run%foundation, run%from, run%to, run%way)
            end associate
        end do
    end subroutine find_free_spans

    !> What is said of a run left the range of double precision in the user's units
    pure subroutine refuse_run(assembled, run, what, unit, error)
        type(assembled_type), intent(in) :: assembled
        type(run_type), intent(in) :: run
        !> What it is, and what it is measured in
        character(len=*), intent(in) :: what, unit
        type(error_type), allocatable, intent(out) :: error

        call refuse_range(error, what//" of "//trim(named(of_foundations, run%foundation, size(assembled%model%foundations)))// &
                          " from x = "//trim(shown(run%from))//" is too great", "choose a greater unit of "//unit)
    end subroutine refuse_run

end module gapbeam_ground_zones

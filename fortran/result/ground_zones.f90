!> Where the ground acts on the beam, and where the beam hangs free above it, in the user's units: for all languages
module gapbeam_ground_zones
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_words, only: shown
    use gapbeam_refusal, only: refuse_range, named, of_foundations
    use gapbeam_scene, only: gapbeam_both, gapbeam_below
    use gapbeam_lowered, only: lowered_type, point_x
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_query, only: largest_ways
    use gapbeam_pieces, only: gapbeam_closed, gapbeam_bilateral, gapbeam_branch
    implicit none
    private
    public :: run_type, contact_type, free_span_type, ground_runs, find_contact, find_free_spans

    !> Stretches beside each other in which a layer of ground does the same
    type :: run_type
        !> Number of the foundation in the model, from 1
        integer :: foundation = 0
        !> Side of the layer, gapbeam_both, gapbeam_below or gapbeam_above: a foundation that holds both ways by a law has two
        integer :: side = gapbeam_both
        !> Pieces of its law, 0: none; the piece on which it acts, of a foundation without a law 1, 0: no contact
        integer :: law_pieces = 0, acts = 0
        !> Its ends
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        !> Force on the beam, up; largest distance between beam and ground
        real(wp) :: resultant = 0.0_wp, way = 0.0_wp
    end type run_type

    !> A zone in which a foundation acts
    type :: contact_type
        !> Number of the foundation in the model, from 1
        integer :: foundation
        !> Its ends, from the left end of the beam
        real(wp) :: from, to
        !> gapbeam_closed, gapbeam_bilateral, or gapbeam_branch plus the number of the piece of its law
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
    subroutine find_contact(lowered, solution, zones, error)
        !> The beam, and its solution on the ground
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Foundation by foundation from left to right
        type(contact_type), allocatable, intent(out) :: zones(:)
        !> A force out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(run_type), allocatable :: runs(:)
        integer :: i, n, stat

        call ground_runs(lowered, solution, .false., runs, error)
        if (allocated(error)) return
        allocate (zones(count(runs%acts > 0)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        n = 0
        do i = 1, size(runs)
            associate (run => runs(i))
                if (run%acts == 0) cycle
                if (.not. abs(run%resultant) <= huge(run%resultant)) then
                    call refuse_run(lowered, run, "the force", "force", error)
                    return
                end if
                n = n + 1
                zones(n) = contact_type(run%foundation, run%from, run%to, condition_of(run), run%resultant)
            end associate
        end do
    end subroutine find_contact

    !> What a layer in contact does, as a code
    pure function condition_of(run) result(condition)
        type(run_type), intent(in) :: run
        integer :: condition

        if (run%law_pieces > 0) then
            condition = gapbeam_branch + run%acts
        else
            condition = merge(gapbeam_bilateral, gapbeam_closed, run%side == gapbeam_both)
        end if
    end function condition_of

    !> Stretches in which the beam has no contact with one-sided ground
    subroutine find_free_spans(lowered, solution, spans, error)
        !> As for find_contact
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Foundation by foundation from left to right; of one that holds both ways there are none
        type(free_span_type), allocatable, intent(out) :: spans(:)
        !> A distance out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(run_type), allocatable :: runs(:)
        logical, allocatable :: free(:)
        integer :: i, n, stat

        call ground_runs(lowered, solution, .true., runs, error)
        if (allocated(error)) return
        allocate (free(size(runs)), stat=stat)
        if (stat == 0) then
            free(:) = runs%acts == 0 .and. lowered%model%foundations(runs%foundation)%side /= gapbeam_both
            allocate (spans(count(free)), stat=stat)
        end if
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        n = 0
        do i = 1, size(runs)
            if (.not. free(i)) cycle
            associate (run => runs(i))
                if (.not. run%way <= huge(run%way)) then
                    call refuse_run(lowered, run, "the distance to the ground", "length", error)
                    return
                end if
                n = n + 1
                spans(n) = free_span_type(run%foundation, run%from, run%to, run%way)
            end associate
        end do
    end subroutine find_free_spans

    !> All layers, stretches in which one does the same joined
    subroutine ground_runs(lowered, solution, with_ways, runs, error)
        !> As for find_contact
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Are the distances between beam and ground wanted; otherwise they are 0
        logical, intent(in) :: with_ways
        !> By foundation, of one with two layers the lower first, and from left to right
        type(run_type), allocatable, intent(out) :: runs(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(run_type), allocatable :: found(:)
        type(run_type) :: run
        ! Of every layer of a foundation (a key each) its last run, and the stretch in which that ends
        integer, allocatable :: last_run(:), last_stretch(:), key(:)
        real(wp), allocatable :: way(:, :)
        integer(int64) :: total
        integer :: i, k, m, n, stat

        m = size(solution%piece)
        total = 0
        do i = 1, m
            total = total + lowered%layer_first(solution%piece(i) + 1) - lowered%layer_first(solution%piece(i))
        end do
        stat = merge(1, 0, total > huge(n))
        associate (keys => 2*size(lowered%model%foundations))
            if (stat == 0) allocate (found(total), key(total), last_run(keys), last_stretch(keys), &
                                     way(size(solution%acts, 1), merge(m, 0, with_ways)), stat=stat)
        end associate
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        if (with_ways) call largest_ways(lowered, solution, way)
        last_run(:) = 0
        last_stretch(:) = 0
        n = 0
        do i = 1, m
            associate (j => solution%piece(i), first => lowered%layer_first(solution%piece(i)))
                do k = first, lowered%layer_first(j + 1) - 1
                    run = run_of(k, k - first + 1)
                    associate (of_layer => 2*run%foundation - merge(1, 0, run%side == gapbeam_below))
                        if (last_run(of_layer) > 0 .and. last_stretch(of_layer) == i - 1) then
                            if (found(last_run(of_layer))%acts == run%acts) then
                                call lengthen(found(last_run(of_layer)), run)
                                last_stretch(of_layer) = i
                                cycle
                            end if
                        end if
                        n = n + 1
                        found(n) = run
                        key(n) = of_layer
                        last_run(of_layer) = n
                        last_stretch(of_layer) = i
                    end associate
                end do
            end associate
        end do
        allocate (runs(n), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call sort(found(:n), key(:n), last_run, runs)

    contains

        !> What a layer does under stretch i
        pure function run_of(layer, row) result(made)
            !> Its number among all, and among those of the piece
            integer, intent(in) :: layer, row
            type(run_type) :: made

            associate (l => lowered%layers(layer), j => solution%piece(i), units => lowered%units)
                made%foundation = l%foundation
                made%side = l%side
                made%law_pieces = l%law_last - l%law_first + 1
                made%acts = solution%acts(row, i)
                made%from = point_x(lowered, j - 1) + scale(solution%from(i), units%length)
                made%to = point_x(lowered, j)
                if (i < m) then
                    if (solution%piece(i + 1) == j) made%to = point_x(lowered, j - 1) + scale(solution%to(i), units%length)
                end if
                made%resultant = scale(solution%resultant(row, i), units%force)
                if (with_ways) made%way = max(0.0_wp, scale(way(row, i), units%deflection))
            end associate
        end function run_of

    end subroutine ground_runs

    !> Join the next stretch to a run
    elemental subroutine lengthen(run, next)
        type(run_type), intent(inout) :: run
        type(run_type), intent(in) :: next

        run%to = next%to
        run%resultant = run%resultant + next%resultant
        run%way = max(run%way, next%way)
    end subroutine lengthen

    !> Sort runs by their keys, those of one key left in order
    pure subroutine sort(found, key, place, runs)
        type(run_type), intent(in) :: found(:)
        !> From 1 to size(place)
        integer, intent(in) :: key(:)
        !> Work: where the next run of a key goes
        integer, intent(inout) :: place(:)
        type(run_type), intent(out) :: runs(:)
        integer :: i, at, number

        place(:) = 0
        do i = 1, size(found)
            place(key(i)) = place(key(i)) + 1
        end do
        at = 1
        do i = 1, size(place)
            number = place(i)
            place(i) = at
            at = at + number
        end do
        do i = 1, size(found)
            runs(place(key(i))) = found(i)
            place(key(i)) = place(key(i)) + 1
        end do
    end subroutine sort

    !> What is said of a run left the range of double precision in the user's units
    pure subroutine refuse_run(lowered, run, what, unit, error)
        type(lowered_type), intent(in) :: lowered
        type(run_type), intent(in) :: run
        !> What it is, and what it is measured in
        character(len=*), intent(in) :: what, unit
        type(error_type), allocatable, intent(out) :: error

        call refuse_range(error, what//" of "//trim(named(of_foundations, run%foundation, size(lowered%model%foundations)))// &
                          " from x = "//trim(shown(run%from))//" is too great", "choose a greater unit of "//unit)
    end subroutine refuse_run

end module gapbeam_ground_zones

!> Layers of the ground along a solved beam: stretches in which a layer does the same, joined, in the user's units.
module gapbeam_ground_runs
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: gapbeam_both, gapbeam_below
    use gapbeam_layers, only: layer_type, branches_of_law, other_way
    use gapbeam_assembled_model, only: assembled_type, point_x, place_x
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_distance, only: largest_ways, is_shallow
    implicit none
    private
    public :: run_type, ground_runs

    !> Places nearer to each other than this share of the beam are one: where beam and ground only touch, that is all that rounding
    !> leaves of the place (sqrt(epsilon): their distance grows with the square of the way from it)
    real(wp), parameter :: one_place = 16*sqrt(epsilon(1.0_wp))

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
        !> Is it a place at which the beam only touches the layer: a zone of no length, or one that rounding alone gives a length
        logical :: touches = .false.
    end type run_type

contains

    !> All layers, stretches in which one does the same joined
    subroutine ground_runs(assembled, solution, runs, error, only_acts)
        !> The beam, and its solution on the ground
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> By foundation, of one with two layers the lower first, and from left to right; where a beam touches in a stretch without
        !> contact after that stretch, and point forces of rigid ground after what is left of them. At most three times as many as
        !> stretches have layers
        type(run_type), allocatable, intent(out) :: runs(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        !> Is nothing asked but where layers act: no forces, no distances, no places that only touch; default .false.
        logical, intent(in), optional :: only_acts
        type(run_type), allocatable :: found(:)
        type(run_type) :: run
        ! Of every layer of a foundation (a key each) its last run, the stretch in which that ends, and where it was touched last
        integer, allocatable :: last_run(:), last_stretch(:), key(:)
        real(wp), allocatable :: way(:, :), touch(:, :, :), last_touch(:)
        logical, allocatable :: supported(:)
        logical :: bare
        integer(int64) :: total
        real(wp) :: length
        integer :: i, k, m, n, stat

        bare = .false.
        if (present(only_acts)) bare = only_acts
        m = size(solution%piece)
        length = point_x(assembled, size(assembled%pieces))
        total = 0
        do i = 1, m
            total = total + assembled%layer_first(solution%piece(i) + 1) - assembled%layer_first(solution%piece(i))
        end do
        allocate (way(size(solution%acts, 1), m), touch(2, size(solution%acts, 1), m), supported(0:size(assembled%pieces)), &
                  stat=stat)
        if (stat == 0 .and. .not. bare) then
            call largest_ways(assembled, solution, way, touch)
            total = total + count(touch >= 0.0_wp, kind=int64)
            if (allocated(solution%push)) total = total + count(solution%pushing > 0, kind=int64)
        end if
        if (stat == 0) stat = merge(1, 0, total > huge(n))
        associate (keys => 2*size(assembled%model%foundations))
            if (stat == 0) allocate (found(total), key(total), last_run(keys), last_stretch(keys), last_touch(keys), stat=stat)
        end associate
        if (failed(stat, error)) return
        supported(:) = .false.
        do k = 1, size(assembled%beam%supports)
            associate (s => assembled%beam%supports(k))
                if (s%stiffness > huge(1.0_wp) .and. s%node < size(supported)) supported(s%node) = .true.
            end associate
        end do
        last_run(:) = 0
        last_stretch(:) = 0
        last_touch(:) = -huge(1.0_wp)
        n = 0
        do i = 1, m
            associate (j => solution%piece(i), first => assembled%layer_first(solution%piece(i)))
                do k = first, assembled%layer_first(j + 1) - 1
                    run = run_of(k, k - first + 1)
                    associate (of_layer => 2*run%foundation - merge(1, 0, run%side == gapbeam_below))
                        if (starts_piece(i) .and. pushes(i - 1, k)) call add_point(i - 1, of_layer)
                        if (begins(of_layer, run)) then
                            n = n + 1
                            found(n) = run
                            key(n) = of_layer
                            last_run(of_layer) = n
                        else
                            call lengthen(found(last_run(of_layer)), run)
                        end if
                        if (run%acts == 0 .and. .not. (bare .or. holds_the_other_way(i, k))) then
                            call add_touches(k, k - first + 1, of_layer)
                        end if
                        last_stretch(of_layer) = i
                        if (pushes(i, k)) call add_point(i, of_layer)
                    end associate
                end do
            end associate
        end do
        allocate (runs(n), stat=stat)
        if (failed(stat, error)) return
        call sort(found(:n), key(:n), last_run, runs)

    contains

        !> What a layer does under stretch i
        pure function run_of(layer, row) result(made)
            !> Its number among all, and among those of the piece
            integer, intent(in) :: layer, row
            type(run_type) :: made

            associate (l => assembled%layers(layer), j => solution%piece(i), units => assembled%units)
                made%foundation = l%foundation
                made%side = l%side
                made%law_pieces = branches_of_law(l)
                made%acts = solution%acts(row, i)
                made%from = place_x(assembled, j, solution%from(i))
                made%to = point_x(assembled, j)
                if (i < m) then
                    if (solution%piece(i + 1) == j) made%to = place_x(assembled, j, solution%to(i))
                end if
                if (bare) return
                made%resultant = scale(solution%resultant(row, i), units%force)
                made%way = max(0.0_wp, scale(way(row, i), units%deflection))
                if (l%rigid) return
                if (made%acts == 1 .and. made%side /= gapbeam_both .and. made%to - made%from <= one_place*length) then
                    made%touches = acts_beside(i - 1, l) <= 0 .and. acts_beside(i + 1, l) <= 0 .and. &
                        is_shallow(assembled, solution, i, layer)
                end if
            end associate
        end function run_of

        !> Does ground that holds both ways push on a stretch, but not by this layer
        pure function holds_the_other_way(stretch, layer) result(it_does)
            !> Number of the stretch; layer among all
            integer, intent(in) :: stretch, layer
            logical :: it_does
            integer :: other

            associate (first => assembled%layer_first(solution%piece(stretch)), &
                       next => assembled%layer_first(solution%piece(stretch) + 1))
                other = other_way(assembled%layers(first:next - 1), layer - first + 1)
            end associate
            it_does = other > 0
            if (it_does) it_does = solution%acts(other, stretch) > 0
        end function holds_the_other_way

        !> Is a stretch in a zone
        pure function is_in_zone(stretch) result(is_in)
            integer, intent(in) :: stretch
            logical :: is_in

            is_in = .false.
            if (stretch > 0 .and. stretch <= m) is_in = any(solution%acts(:, stretch) > 0)
        end function is_in_zone

        !> Does a layer of rigid ground push with a point force between two stretches
        pure function pushes(border, layer)
            !> Number of the stretch left of it; layer among all
            integer, intent(in) :: border, layer
            logical :: pushes

            pushes = .false.
            if (allocated(solution%push) .and. .not. bare) pushes = solution%pushing(border) == layer
        end function pushes

        !> A run of no length where rigid ground pushes with a point force
        subroutine add_point(border, of_layer)
            !> As for pushes, and the key of the layer
            integer, intent(in) :: border, of_layer

            n = n + 1
            found(n) = run
            found(n)%acts = 1
            found(n)%from = merge(run%from, run%to, border < i)
            found(n)%to = found(n)%from
            found(n)%resultant = scale(solution%push(border), assembled%units%force)
            found(n)%way = 0.0_wp
            key(n) = of_layer
            ! A zone goes on beyond it, a free span ends
            if (.not. (is_in_zone(border) .or. is_in_zone(border + 1))) last_run(of_layer) = n
        end subroutine add_point

        !> Does a stretch begin a new run of its layer
        pure function begins(of_layer, next)
            integer, intent(in) :: of_layer
            type(run_type), intent(in) :: next
            logical :: begins

            begins = last_run(of_layer) == 0 .or. last_stretch(of_layer) /= i - 1
            if (.not. begins) begins = found(last_run(of_layer))%acts /= next%acts
        end function begins

        !> What the same layer does in another stretch: the piece on which it acts, 0: no contact, -1: it is not there
        pure function acts_beside(other, layer) result(acts)
            integer, intent(in) :: other
            type(layer_type), intent(in) :: layer
            integer :: acts, row

            acts = -1
            if (other < 1 .or. other > m) return
            associate (first => assembled%layer_first(solution%piece(other)))
                do row = first, assembled%layer_first(solution%piece(other) + 1) - 1
                    if (assembled%layers(row)%foundation == layer%foundation .and. assembled%layers(row)%side == layer%side) then
                        acts = solution%acts(row - first + 1, other)
                    end if
                end do
            end associate
        end function acts_beside

        !> Where the beam touches a layer in stretch i; not at the ends of zones, and not where a rigid support is
        subroutine add_touches(layer, row, of_layer)
            !> As for run_of, and its key
            integer, intent(in) :: layer, row, of_layer
            real(wp) :: x, from, to
            integer :: t, left, right

            left = acts_beside(i - 1, assembled%layers(layer))
            right = acts_beside(i + 1, assembled%layers(layer))
            from = run%from
            to = run%to
            do t = 1, 2
                associate (at => touch(t, row, i), j => solution%piece(i))
                    if (at < 0.0_wp) exit
                    x = from + (to - from)*at
                    if (at >= 1.0_wp) x = to
                    if (at <= 0.0_wp .and. left >= 0) cycle
                    if (allocated(solution%push)) then
                        if (at <= 0.0_wp .and. solution%pushing(i - 1) > 0) cycle
                        if (at >= 1.0_wp .and. solution%pushing(i) > 0) cycle
                    end if
                    if (left > 0 .and. x - from <= one_place*length) cycle
                    if (right > 0 .and. to - x <= one_place*length) cycle
                    if (x - last_touch(of_layer) <= one_place*length) cycle
                    if (at <= 0.0_wp .and. starts_piece(i) .and. supported(j - 1)) cycle
                    if (at >= 1.0_wp .and. starts_piece(i + 1) .and. supported(j)) cycle
                end associate
                n = n + 1
                found(n) = run
                found(n)%from = x
                found(n)%to = x
                found(n)%way = 0.0_wp
                found(n)%resultant = 0.0_wp
                found(n)%touches = .true.
                key(n) = of_layer
                last_touch(of_layer) = x
            end do
        end subroutine add_touches

        !> Does a stretch begin where its piece of the beam does, or the beam end before it
        pure function starts_piece(stretch) result(starts)
            integer, intent(in) :: stretch
            logical :: starts

            starts = stretch == 1 .or. stretch > m
            if (.not. starts) starts = solution%piece(stretch) /= solution%piece(stretch - 1)
        end function starts_piece

    end subroutine ground_runs

    !> Join the next stretch to a run
    elemental subroutine lengthen(run, next)
        type(run_type), intent(inout) :: run
        type(run_type), intent(in) :: next

        run%to = next%to
        run%resultant = run%resultant + next%resultant
        run%way = max(run%way, next%way)
        run%touches = .false.
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

end module gapbeam_ground_runs

!> Nodes with several supports in eight cases: common stiffness, wrong states, shares of the force.
!> What those that act make of their node, which of them are wrong, and what each has of the force there. gapbeam_law for ordinary
!> supports, number by number. The scheme makes one support of those at a node: a rigid one or a spring that always acts, with
!> their forces beside the load
module gapbeam_lane_shared
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: sign_width
    use gapbeam_lane_types, only: lanes, lane_beam_type
    implicit none
    private
    public :: keep_loads, join_supports, find_levels, find_wrong_beside, wait_beside, share_forces

contains

    !> Keep the loads at the nodes, to which join_supports adds
    pure subroutine keep_loads(beam, n, shear, load)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in) :: shear(lanes, 0:n)
        !> Shape (lanes, nodes with several supports)
        real(wp), intent(out) :: load(lanes, size(beam%shared))
        integer :: g

        do g = 1, size(beam%shared)
            load(:, g) = shear(:, beam%shared(g))
        end do
    end subroutine keep_loads

    !> Change supports, and make one of those that act at a node: add_supports of gapbeam_law
    pure subroutine join_supports(beam, n, last, load, change, closed, stiffness, rigid, contact, shear)
        type(lane_beam_type), intent(in) :: beam
        !> Links, and the last place of a support
        integer, intent(in) :: n, last
        !> By keep_loads
        real(wp), intent(in) :: load(lanes, size(beam%shared))
        !> 1 where a support is to be changed in, 0 out; pack_type
        real(wp), intent(inout), dimension(lanes, 0:last) :: change, closed, stiffness, rigid, contact
        real(wp), intent(inout) :: shear(lanes, 0:n)
        real(wp), dimension(lanes) :: taken, known, spring, force
        real(wp) :: acts, one_sided, k
        integer :: g, i, j, l

        do g = 1, size(beam%shared)
            i = beam%shared(g)
            taken(:) = 0.0_wp
            known(:) = 0.0_wp
            spring(:) = 0.0_wp
            force(:) = load(:, g)
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                if (beam%changes(j) < 0.5_wp) taken(:) = larger(taken, rigid(:, j)*closed(:, j))
            end do
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                one_sided = beam%changes(j)
                !$omp simd private(acts, k)
                do l = 1, lanes
                    acts = abs(closed(l, j) - change(l, j))
                    ! Two rigid ones cannot both act (separate_rigid_pairs)
                    acts = acts*(1.0_wp - one_sided*rigid(l, j)*taken(l))
                    taken(l) = larger(taken(l), acts*rigid(l, j))
                    closed(l, j) = acts
                    change(l, j) = 0.0_wp
                    known(l) = known(l) + acts*rigid(l, j)*contact(l, j)
                    k = acts*stiffness(l, j)
                    spring(l) = spring(l) + k
                    force(l) = force(l) + k*contact(l, j)
                end do
            end do
            closed(:, i) = 1.0_wp
            rigid(:, i) = taken
            stiffness(:, i) = spring
            contact(:, i) = known
            shear(:, i) = force
        end do
    end subroutine join_supports

    !> Largest contact levels of the supports that act, as the contact of their node
    pure subroutine find_levels(beam, last, closed, contact)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: last
        real(wp), intent(in) :: closed(lanes, 0:last)
        real(wp), intent(inout) :: contact(lanes, 0:last)
        real(wp) :: level(lanes)
        integer :: g, j

        do g = 1, size(beam%shared)
            level(:) = 0.0_wp
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                level(:) = larger(level, closed(:, j)*abs(contact(:, j)))
            end do
            contact(:, beam%shared(g)) = level
        end do
    end subroutine find_levels

    !> Which of them have the wrong state
    pure subroutine find_wrong_beside(beam, n, last, alive, load, stiffness, rigid, contact, closed, w, ml, mr, wrong, number)
        type(lane_beam_type), intent(in) :: beam
        !> As for join_supports
        integer, intent(in) :: n, last
        !> Cases that are looked at
        real(wp), intent(in) :: alive(lanes)
        real(wp), intent(in) :: load(lanes, size(beam%shared))
        real(wp), intent(in), dimension(lanes, 0:last) :: stiffness, rigid, contact, closed
        !> Solution
        real(wp), intent(in), dimension(lanes, 0:n) :: w, ml, mr
        !> 1 where wrong; those at other places stay
        real(wp), intent(inout) :: wrong(lanes, 0:last)
        !> How many are wrong, raised
        real(wp), intent(inout) :: number(lanes)
        real(wp) :: force(lanes), bad, side, changes, h_left, h_right
        integer :: g, i, j, l, before, after

        do g = 1, size(beam%shared)
            i = beam%shared(g)
            before = max(i - 1, 0)
            after = min(i + 1, n)
            h_left = 0.0_wp
            h_right = 0.0_wp
            if (i > 0) h_left = beam%inverse(i)
            if (i < n) h_right = beam%inverse(after)
            force(:) = load(:, g) - (ml(:, i) - mr(:, before))*h_left + (ml(:, after) - mr(:, i))*h_right
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                force(:) = force - closed(:, j)*stiffness(:, j)*(w(:, i) - contact(:, j))
            end do
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                side = beam%side(j)
                changes = beam%changes(j)
                !$omp simd private(bad)
                do l = 1, lanes
                    bad = wrongness(side, closed(l, j), stiffness(l, j), closed(l, j)*rigid(l, j), contact(l, j), w(l, i), &
                                    force(l))*changes*alive(l)
                    bad = merge(1.0_wp, 0.0_wp, bad > 0.0_wp)
                    wrong(l, j) = bad
                    number(l) = number(l) + bad
                end do
            end do
        end do
    end subroutine find_wrong_beside

    !> Where there is no progress, change only those at every other node, in turn (keep_every_other of gapbeam_lane_search)
    pure subroutine wait_beside(beam, last, solve, waits, wrong)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: last
        !> Which solve it is, and 1 in cases without progress
        integer, intent(in) :: solve
        real(wp), intent(in) :: waits(lanes)
        real(wp), intent(inout) :: wrong(lanes, 0:last)
        integer :: g, j

        do g = 1, size(beam%shared)
            if (modulo(beam%shared(g) - solve, 2) /= 0) cycle
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                wrong(:, j) = wrong(:, j)*(1.0_wp - waits)
            end do
        end do
    end subroutine wait_beside

    !> What each has of the force at its node, and whether signs and digits are certain: share_forces and margin_of of gapbeam_law
    pure subroutine share_forces(beam, n, last, load, load_size, stiffness, rigid, contact, closed, w, room, reaction, largest, &
                                 worst, doubtful)
        type(lane_beam_type), intent(in) :: beam
        !> As for join_supports
        integer, intent(in) :: n, last
        real(wp), intent(in) :: load(lanes, size(beam%shared))
        real(wp), intent(in), dimension(lanes, 0:last) :: stiffness, rigid, contact, closed
        real(wp), intent(in), dimension(lanes, 0:n) :: load_size, w
        !> By find_sizes and find_shears of gapbeam_lane_reactions
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        !> Those at other places stay
        real(wp), intent(inout) :: reaction(lanes, 0:last)
        !> The largest reaction and the largest rounding error of one, raised; doubt, added
        real(wp), intent(inout), dimension(lanes) :: largest, worst, doubtful
        real(wp), dimension(lanes) :: force, error, elastic, elastic_error, most, which, hold
        real(wp) :: by_spring, spring_error, r, r_error, margin, rounding, c, bad, side, changes
        integer :: g, i, j, k, l

        do g = 1, size(beam%shared)
            i = beam%shared(g)
            k = min(i + 1, n)
            !$omp simd private(r, r_error)
            do l = 1, lanes
                r = 0.0_wp
                r_error = 0.0_wp
                if (i < n) then
                    r = room(l, k, 5)
                    r_error = room(l, k, 6)
                end if
                error(l) = epsilon(1.0_wp)*load_size(l, i) + room(l, i, 6) + r_error
                force(l) = load(l, g) - (room(l, i, 5) - r)
                error(l) = larger(error(l), epsilon(1.0_wp)*room(l, i, 1))
                elastic(l) = 0.0_wp
                elastic_error(l) = 0.0_wp
                most(l) = 0.0_wp
                which(l) = 0.0_wp
                hold(l) = 0.0_wp
            end do
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                !$omp simd private(spring_error)
                do l = 1, lanes
                    spring_error = closed(l, j)*(epsilon(1.0_wp)*stiffness(l, j)*larger(room(l, i, 2), abs(contact(l, j))))
                    elastic(l) = elastic(l) + closed(l, j)*(stiffness(l, j)*(w(l, i) - contact(l, j)))
                    elastic_error(l) = elastic_error(l) + spring_error
                    which(l) = merge(real(j, wp), which(l), spring_error > most(l))
                    most(l) = larger(most(l), spring_error)
                    hold(l) = hold(l) + closed(l, j)*rigid(l, j)
                end do
            end do
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                side = beam%side(j)
                changes = beam%changes(j)
                !$omp simd private(by_spring, spring_error, r, r_error, margin, rounding, c, bad)
                do l = 1, lanes
                    by_spring = stiffness(l, j)*(w(l, i) - contact(l, j))
                    spring_error = epsilon(1.0_wp)*stiffness(l, j)*larger(room(l, i, 2), abs(contact(l, j)))
                    ! What the others leave of the force at the node
                    r = force(l) - (elastic(l) - by_spring)
                    r_error = error(l) + (elastic_error(l) - spring_error)
                    c = merge(1.0_wp, 0.0_wp, r_error < spring_error)*(1.0_wp - rigid(l, i))
                    c = merge(c, 0.0_wp, abs(which(l) - j) < 0.5_wp)
                    r = merge(r, by_spring, c > 0.5_wp)
                    r_error = merge(r_error, spring_error, c > 0.5_wp)
                    c = force(l) - elastic(l)
                    r = merge(c, r, rigid(l, j) > 0.5_wp)
                    c = error(l) + epsilon(1.0_wp)*abs(elastic(l))
                    r_error = merge(c, r_error, rigid(l, j) > 0.5_wp)
                    c = closed(l, j)
                    associate (deflection_size => room(l, i, 2), contact => contact(l, j), w => w(l, i))
                        include 'cases/support_margin.inc'
                    end associate
                    reaction(l, j) = r
                    largest(l) = larger(largest(l), abs(r))
                    worst(l) = larger(worst(l), r_error)
                    bad = merge(bad, 1.0_wp, abs(r) <= huge(1.0_wp))
                    doubtful(l) = doubtful(l) + bad
                end do
            end do
            doubtful(:) = doubtful + merge(1.0_wp, 0.0_wp, hold > 1.5_wp)
        end do
    end subroutine share_forces

    include 'cases/wrongness.inc'

    include 'cases/larger.inc'

end module gapbeam_lane_shared

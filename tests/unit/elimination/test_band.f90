!> The sweep through the mixed system against the pivoting route, node by node and kind by kind
program test_band
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type, factor_chain, band_ok, band_mechanism, &
        band_needs_pivoting, count_unstable_pivots, plain, hinge, restrained
    use gapbeam_band_substitution, only: solve_chain
    use gapbeam_residual, only: residual_chain, size_type
    use gapbeam_three_moment, only: fits_three_moment, solve_three_moment
    use gapbeam_pivoting, only: solve_pivoting, count_unstable
    implicit none
    integer :: status

    call every_kind_of_node()
    call falling_springs()
    call rigid_supports_only()
    call mechanisms()
    call rigid_beam_on_rigid_supports()
    call long_chain()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A reproducible number between 0 and 1
    function fraction_of(seed) result(number)
        integer, intent(inout) :: seed
        real(wp) :: number

        seed = modulo(seed*75 + 74, 65537)
        number = real(seed, wp)/65537
    end function fraction_of

    !> Links of random lengths and stiffnesses, and a random right-hand side
    subroutine make(seed, n, links, rhs)
        integer, intent(inout) :: seed
        integer, intent(in) :: n
        type(link_type), allocatable, intent(out) :: links(:)
        type(rhs_type), allocatable, intent(out) :: rhs(:)
        type(piece_load_type) :: none(1)
        real(wp) :: work(1)
        integer :: i

        allocate (links(n), rhs(0:n))
        none = piece_load_type(0, 0, 0, 0, 0)
        do i = 1, n
            call condense_link([piece_type(1 + fraction_of(seed), 0.5_wp + fraction_of(seed), fraction_of(seed)/2)], &
                               none, none, work, links(i))
        end do
        do i = 0, n
            rhs(i) = rhs_type(fraction_of(seed) - 0.5_wp, fraction_of(seed) - 0.5_wp, fraction_of(seed) - 0.5_wp, &
                              0.1_wp*fraction_of(seed), 0.0_wp)
            if (i == 0) rhs(i)%left = 0.0_wp
            if (i == n) rhs(i)%right = 0.0_wp
        end do
    end subroutine make

    !> Solve both ways and compare
    subroutine compare(nodes, links, rhs, name)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        character(len=*), intent(in) :: name
        type(pivot_type) :: pivots(0:size(links))
        type(rhs_type) :: work(0:size(links)), residual(0:size(links))
        type(answer_type) :: sweep(0:size(links)), pivoted(0:size(links))
        type(size_type) :: sizes(0:size(links))
        integer :: state, place
        logical :: regular

        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_ok, name//": factored")
        if (state /= band_ok) return
        work = rhs
        call solve_chain(nodes, links, pivots, work, sweep)
        call solve_pivoting(nodes, links, rhs, pivoted, regular)
        call check(regular, name//": regular with pivoting")
        call check_close(sweep%deflection, pivoted%deflection, name//": deflections", 1e-11_wp)
        call check_close(sweep%moment_left, pivoted%moment_left, name//": moments left", 1e-11_wp)
        call check_close(sweep%moment_right, pivoted%moment_right, name//": moments right", 1e-11_wp)
        call residual_chain(nodes, links, rhs, sweep, residual, sizes)
        call check(maxval(abs([residual%left, residual%right])) < 1e-13_wp*maxval([sizes%left, sizes%right]) .and. &
                   maxval(abs(residual%shear)) < 1e-13_wp*maxval(sizes%shear), name//": residuals")
    end subroutine compare

    !> Overhangs, hinges, springs, clamps, couples, suspended parts
    subroutine every_kind_of_node()
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(node_type), allocatable :: nodes(:)
        integer :: seed, n

        seed = 7
        n = 9
        call make(seed, n, links, rhs)
        allocate (nodes(0:n))
        nodes(2)%held = .true.
        nodes(7)%stiffness = 3.0_wp
        rhs(4)%couple = 0.7_wp
        rhs(0)%couple = 0.3_wp
        rhs(9)%couple = -0.2_wp
        call compare(nodes, links, rhs, "two supports and overhangs")
        nodes(1)%stiffness = 1e-6_wp
        nodes(0)%stiffness = 2.0_wp
        nodes(5)%kind = hinge
        nodes(8)%held = .true.
        call compare(nodes, links, rhs, "a hinge between supports")
        nodes(3)%kind = restrained
        nodes(3)%compliance = 0.4_wp
        nodes(6)%kind = restrained
        nodes(6)%compliance = 0.0_wp
        rhs(3)%couple = 0.5_wp
        rhs(6)%couple = -0.5_wp
        call compare(nodes, links, rhs, "a rotational spring and a clamp inside")
        nodes = node_type()
        nodes(9) = node_type(restrained, .true., 0.0_wp, 0.0_wp)
        call compare(nodes, links, rhs, "a cantilever to the left")
        nodes(3)%kind = hinge
        rhs(3)%couple = 0.0_wp
        nodes(0)%held = .true.
        call compare(nodes, links, rhs, "a part hung up on a hinge")
        nodes(9) = node_type()
        nodes(0) = node_type(restrained, .true., 0.0_wp, 0.2_wp)
        nodes(3) = node_type(plain, .false., 0.0_wp, 0.0_wp)
        call compare(nodes, links, rhs, "a cantilever to the right on a rotational spring")
        nodes(0) = node_type()
        nodes(4) = node_type(restrained, .true., 0.0_wp, 0.0_wp)
        call compare(nodes, links, rhs, "clamped in the middle alone")
        nodes(4) = node_type(restrained, .false., 2.0_wp, 0.3_wp)
        call compare(nodes, links, rhs, "sprung in the middle alone")
    end subroutine every_kind_of_node

    !> Springs whose force falls: the pivots tell in how many ways the beam gives way, as elimination with all unknowns does
    subroutine falling_springs()
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(node_type) :: nodes(0:9)
        type(pivot_type) :: pivots(0:9)
        integer :: seed, draw, i, state, place, index
        logical :: seen(0:2)

        seed = 11
        seen = .false.
        do draw = 1, 60
            call make(seed, 9, links, rhs)
            nodes = node_type()
            do i = 0, 9
                if (fraction_of(seed) < 0.6_wp) nodes(i)%stiffness = 3*(fraction_of(seed) - 0.3_wp)
                nodes(i)%held = fraction_of(seed) < 0.2_wp
                if (fraction_of(seed) < 0.2_wp) then
                    nodes(i)%kind = restrained
                    nodes(i)%compliance = fraction_of(seed)
                end if
            end do
            nodes(4)%kind = hinge
            call factor_chain(nodes, links, pivots, state, place)
            if (state /= band_ok) cycle
            call count_unstable(nodes, links, index)
            call check(count_unstable_pivots(nodes, pivots) == index, "the index of springs whose force falls")
            seen(min(index, 2)) = .true.
        end do
        call check(all(seen), "stable and unstable beams are drawn")
    end subroutine falling_springs

    !> Three-moment equations against the mixed system
    subroutine rigid_supports_only()
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(node_type), allocatable :: nodes(:)
        integer :: seed, n, left, right

        seed = 11
        n = 6
        do left = 1, 3
            do right = 1, 3
                call make(seed, n, links, rhs)
                if (allocated(nodes)) deallocate (nodes)
                allocate (nodes(0:n))
                nodes%held = .true.
                call make_end(nodes(0), left)
                call make_end(nodes(n), right)
                rhs(2)%couple = 0.4_wp
                rhs(0)%couple = -0.4_wp
                rhs(n)%couple = 0.1_wp
                if (left == 1) rhs(0)%deflection = 0.0_wp
                if (right == 1) rhs(n)%deflection = 0.0_wp
                call compare_three_moment(nodes, links, rhs)
            end do
        end do
        call make(seed, 1, links, rhs)
        call compare_three_moment([node_type(restrained, .true., 0.0_wp, 0.0_wp), node_type()], links, rhs)
        call compare_three_moment([node_type(), node_type(restrained, .true., 0.0_wp, 0.2_wp)], links, rhs)
        call compare_three_moment([node_type(plain, .true., 0.0_wp, 0.0_wp), node_type(plain, .true., 0.0_wp, 0.0_wp)], &
                                  links, rhs)
        call check(.not. fits_three_moment([node_type(), node_type()]), "a free beam does not fit")
        call check(.not. fits_three_moment([node_type(plain, .false., 1.0_wp, 0.0_wp), &
                                            node_type(plain, .true., 0.0_wp, 0.0_wp)]), "an elastic support does not fit")
    end subroutine rigid_supports_only

    !> A free tip, a pinned end or a clamped one
    subroutine make_end(node, which)
        type(node_type), intent(inout) :: node
        integer, intent(in) :: which

        node%held = which > 1
        if (which == 3) node%kind = restrained
    end subroutine make_end

    subroutine compare_three_moment(nodes, links, rhs)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        type(pivot_type) :: pivots(0:size(links))
        type(rhs_type) :: work(0:size(links))
        type(answer_type) :: mixed(0:size(links)), moments(0:size(links))
        real(wp) :: space(2, 0:size(links))
        integer :: state, place
        logical :: regular

        call check(fits_three_moment(nodes), "rigid supports fit three-moment equations")
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_ok, "mixed system factored")
        work = rhs
        call solve_chain(nodes, links, pivots, work, mixed)
        call solve_three_moment(nodes, links, rhs, space, moments, regular)
        call check(regular, "three-moment equations regular")
        call check_close(moments%moment_left, mixed%moment_left, "moments left", 1e-13_wp)
        call check_close(moments%moment_right, mixed%moment_right, "moments right", 1e-13_wp)
        call check_close(moments%deflection, mixed%deflection, "deflections", 1e-12_wp)
    end subroutine compare_three_moment

    !> Found by exact zeros, however stiff or soft the rest is
    subroutine mechanisms()
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(node_type), allocatable :: nodes(:)
        type(pivot_type) :: pivots(0:5)
        integer :: seed, state, place

        seed = 3
        call make(seed, 5, links, rhs)
        allocate (nodes(0:5))
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_mechanism, "a free beam")
        nodes(2)%held = .true.
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_mechanism, "a beam on one support")
        nodes(3)%stiffness = 1e-200_wp
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_ok, "a very soft second support is enough")
        nodes(4)%kind = hinge
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_mechanism, "a part that hangs on a hinge alone")
        nodes(5)%held = .true.
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_ok, "until its end is held")
        nodes(1)%kind = hinge
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_mechanism .and. place == 1, "a hanging part at the left end")
    end subroutine mechanisms

    !> The one case that needs pivoting
    subroutine rigid_beam_on_rigid_supports()
        type(link_type) :: links(3)
        type(piece_load_type) :: none(1)
        type(node_type) :: nodes(0:3)
        type(rhs_type) :: rhs(0:3)
        type(pivot_type) :: pivots(0:3)
        type(answer_type) :: answers(0:3)
        real(wp) :: work(1)
        integer :: i, state, place
        logical :: regular

        none = piece_load_type(0, 0, 0, 0, 0)
        do i = 1, 3
            call condense_link([piece_type(2.0_wp, 0.0_wp, 0.0_wp)], none, none, work, links(i))
        end do
        nodes(0)%held = .true.
        nodes(1)%held = .true.
        rhs%shear = [0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp]
        rhs(1)%deflection = 0.5_wp
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_needs_pivoting, "rigid beam on two rigid supports: no pivot")
        call solve_pivoting(nodes, links, rhs, answers, regular)
        call check(regular, "solved with pivoting")
        call check_close(answers%deflection, [0.0_wp, 0.5_wp, 1.0_wp, 1.5_wp], "it stays straight")
        call check_close(answers%moment_left, [0.0_wp, -6.0_wp, -2.0_wp, 0.0_wp], "moments by statics")
        nodes(3)%held = .true.
        call solve_pivoting(nodes, links, rhs, answers, regular)
        call check(.not. regular, "on three rigid supports it is not determined")
    end subroutine rigid_beam_on_rigid_supports

    !> A simple beam in 100,000 links keeps twelve digits of its deflection
    subroutine long_chain()
        integer, parameter :: n = 100000
        type(link_type), allocatable :: links(:)
        type(node_type), allocatable :: nodes(:)
        type(rhs_type), allocatable :: rhs(:)
        type(pivot_type), allocatable :: pivots(:)
        type(answer_type), allocatable :: answers(:)
        type(piece_load_type) :: none(1)
        real(wp) :: work(1), h
        integer :: state, place

        allocate (links(n), nodes(0:n), rhs(0:n), pivots(0:n), answers(0:n))
        h = 1.0_wp/n
        none = piece_load_type(1, 1, 0, 0, 0)
        call condense_link([piece_type(h, 1.0_wp, 0.0_wp)], none, none, work, links(1))
        links = links(1)
        nodes(0)%held = .true.
        nodes(n)%held = .true.
        rhs = rhs_type(links(1)%turn_b(1), links(1)%turn_a(1), h, 0.0_wp, 0.0_wp)
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_ok, "100,000 links factored")
        call solve_chain(nodes, links, pivots, rhs, answers)
        call check_close(answers(n/2)%moment_left, 0.125_wp, "moment at midspan", 1e-11_wp)
        call check_close(answers(n/2)%deflection, 5.0_wp/384, "deflection at midspan", 1e-10_wp)
    end subroutine long_chain

end program test_band

!> States and forces of supports by their laws.
!> No module but this one, gapbeam_law_margins, gapbeam_polyline, gapbeam_law_kinematics and gapbeam_law_adapters knows the laws.
!>
!> The law of a support is a polyline of its reaction (positive up) over the deflection of its node, and its state is the piece on
!> which it is:
!>
!>     open      no reaction, on the free side of the contact level
!>     closed    stiffness times the deflection beyond the contact level; if rigid, whatever reaction it takes at that level
!>
!> A support that holds both ways has the second piece only, one of stiffness 0 the first only: their states never change. A
!> scheme is the states of all supports, kept as a logical array: `closed(k)` is true on the second piece. How far a support is
!> from the end of its piece is its margin (gapbeam_law_margins); below zero its state is wrong, and the right one lies beyond
!> that end: with two pieces the other one. A law with more pieces is one support for every breakpoint between them
!> (gapbeam_polyline).
!>
!> Loops over supports stand here as well, since procedures of other files are not inlined.
module gapbeam_law
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_polyline, only: node_support_type, piece_that_acts, piece_force, open_from, advance_one_segment, &
        jump_to_plateau
    implicit none
    private
    public :: node_support_type, below, above, both
    public :: is_support, is_rigid, always_closed, separate_rigid_pairs
    public :: add_supports, share_forces, force_by_spring, is_plainly_right
    public :: has_laws, open_from, advance_one_segment, jump_to_plateau

    !> Sides of a support: pushes up only, pushes down only, both
    integer, parameter :: below = 1, above = -1, both = 0

contains

    ! States

    !> Are the numbers of a support such as they may be
    elemental function is_support(support) result(it_is)
        type(node_support_type), intent(in) :: support
        logical :: it_is

        it_is = abs(support%side) <= 1 .and. (support%stiffness >= 0.0_wp .or. support%breakpoint > 0) &
            .and. abs(support%contact) <= huge(support%contact)
    end function is_support

    !> Has any support a law
    pure function has_laws(supports) result(any_has)
        type(node_support_type), intent(in) :: supports(:)
        logical :: any_has

        any_has = any(supports%breakpoint > 0)
    end function has_laws

    !> Is a support rigid
    elemental function is_rigid(support) result(rigid)
        type(node_support_type), intent(in) :: support
        logical :: rigid

        rigid = support%stiffness > huge(support%stiffness)
    end function is_rigid

    !> Which supports are closed in every scheme
    pure function always_closed(supports) result(always)
        type(node_support_type), intent(in) :: supports(:)
        logical :: always(size(supports))

        always(:) = supports%side == both
    end function always_closed

    !> Two rigid supports at one node cannot both act: begin with the one that holds both ways, or with the first
    pure subroutine separate_rigid_pairs(supports, last, closed)
        type(node_support_type), intent(in) :: supports(:)
        !> Last node
        integer, intent(in) :: last
        logical, intent(inout) :: closed(:)
        logical, allocatable :: taken(:)
        integer :: k

        allocate (taken(0:last), source=.false.)
        do k = 1, size(closed)
            associate (s => supports(k))
                if (s%side == both .and. is_rigid(s)) taken(s%node) = .true.
            end associate
        end do
        do k = 1, size(closed)
            associate (s => supports(k))
                if (s%side == both .or. .not. closed(k) .or. .not. is_rigid(s) .or. s%breakpoint > 0) cycle
                closed(k) = .not. taken(s%node)
                taken(s%node) = .true.
            end associate
        end do
    end subroutine separate_rigid_pairs

    ! Forces

    !> Add stiffness and load of the acting supports to their nodes; a rigid one holds its node at the contact level
    pure subroutine add_supports(supports, order, acting, nodes, rhs, level, spring, spring_contact)
        !> All supports, the numbers of those at the nodes at hand, and which act
        type(node_support_type), intent(in) :: supports(:)
        integer, intent(in) :: order(:)
        logical, intent(in) :: acting(:)
        !> All nodes and their right-hand sides, shape (0:n)
        type(node_type), intent(inout) :: nodes(0:)
        type(rhs_type), intent(inout) :: rhs(0:)
        !> Raised to the largest absolute contact level of the acting supports of a node, shape (0:n)
        real(wp), intent(inout) :: level(0:)
        !> Springs, and where they are without force, in place of the one-sided supports, acting or not, shape (size(supports))
        !> (contiguous, or gfortran looks at the stride of what is absent)
        real(wp), intent(in), contiguous, optional :: spring(:), spring_contact(:)
        logical :: sprung, acts
        real(wp) :: slope
        integer :: j, k

        sprung = present(spring)
        do j = 1, size(order)
            k = order(j)
            associate (s => supports(k), node => nodes(supports(k)%node), r => rhs(supports(k)%node))
                if (sprung .and. s%side /= both) then
                    node%stiffness = node%stiffness + spring(k)
                    r%shear = r%shear + spring(k)*spring_contact(k)
                else if (s%breakpoint > 0) then
                    call piece_that_acts(supports, acting, k, acts, slope)
                    if (.not. acts) cycle
                    level(s%node) = max(level(s%node), abs(s%contact))
                    if (abs(slope) > huge(slope)) then
                        ! Another one may hold it elsewhere in a scheme that is wrong (past_level)
                        if (.not. node%held) r%deflection = s%contact
                        node%held = .true.
                    else
                        node%stiffness = node%stiffness + slope
                        r%shear = r%shear + (slope*s%contact - s%side*s%force)
                    end if
                else if (acting(k)) then
                    level(s%node) = max(level(s%node), abs(s%contact))
                    if (is_rigid(s)) then
                        node%held = .true.
                        r%deflection = s%contact
                    else
                        node%stiffness = node%stiffness + s%stiffness
                        r%shear = r%shear + s%stiffness*s%contact
                    end if
                end if
            end associate
        end do
    end subroutine add_supports

    !> Reactions: what the supports of a node have of the force that it takes, or from the spring where that is more exact
    pure subroutine share_forces(supports, order, first, acting, range, nodes, answers, deflection_size, force, force_error, &
                                 reaction, reaction_error)
        !> All supports; those at node i are order(first(i)) to order(first(i + 1) - 1); which act
        type(node_support_type), intent(in) :: supports(:)
        integer, intent(in) :: order(:), first(0:)
        logical, intent(in) :: acting(:)
        !> First and last node
        integer, intent(in) :: range(2)
        !> All nodes, their deflections, and the sizes of these for rounding errors, shape (0:n)
        type(node_type), intent(in) :: nodes(0:)
        type(answer_type), intent(in) :: answers(0:)
        real(wp), intent(in) :: deflection_size(0:)
        !> Force of all supports together at the nodes of the range, and its rounding error
        real(wp), intent(in) :: force(range(1):), force_error(range(1):)
        !> Reactions and the rounding errors that they may have, shape (size(supports)); those at other nodes stay
        real(wp), intent(inout) :: reaction(:), reaction_error(:)
        real(wp) :: by_spring, spring_error, elastic, elastic_error, worst_error
        integer :: i, j, k, company, worst
        logical :: acts, rigid

        if (checked) call require(size(force) > range(2) - range(1) .and. size(force_error) > range(2) - range(1), &
                                  "share_forces: shapes")
        do i = range(1), range(2)
            company = 0
            elastic = 0.0_wp
            elastic_error = 0.0_wp
            worst_error = 0.0_wp
            worst = 0
            do j = first(i), first(i + 1) - 1
                k = order(j)
                reaction(k) = 0.0_wp
                reaction_error(k) = 0.0_wp
                if (.not. acting(k) .and. supports(k)%breakpoint == 0) cycle
                call force_by_spring(supports, acting, k, answers(i)%deflection, deflection_size(i), acts, rigid, by_spring, &
                                     spring_error)
                if (.not. acts) cycle
                company = company + 1
                if (rigid) cycle
                elastic = elastic + by_spring
                elastic_error = elastic_error + spring_error
                if (spring_error > worst_error) worst = k
                worst_error = max(worst_error, spring_error)
            end do
            if (company == 0) cycle
            do j = first(i), first(i + 1) - 1
                k = order(j)
                if (.not. acting(k) .and. supports(k)%breakpoint == 0) cycle
                call force_by_spring(supports, acting, k, answers(i)%deflection, deflection_size(i), acts, rigid, by_spring, &
                                     spring_error)
                if (.not. acts) cycle
                if (rigid) then
                    reaction(k) = force(i) - elastic
                    reaction_error(k) = force_error(i) + epsilon(1.0_wp)*abs(elastic)
                else if (k == worst .and. force_error(i) + (elastic_error - spring_error) < spring_error &
                         .and. .not. nodes(i)%held) then
                    ! What the others leave of the force at the node
                    reaction(k) = force(i) - (elastic - by_spring)
                    reaction_error(k) = force_error(i) + (elastic_error - spring_error)
                else
                    reaction(k) = by_spring
                    reaction_error(k) = spring_error
                end if
            end do
        end do
    end subroutine share_forces

    !> Does a support act, is it rigid then, and if not, its force by its law
    pure subroutine force_by_spring(supports, acting, k, deflection, deflection_size, acts, rigid, force, rounding)
        !> As for share_forces, and the number of the support
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: acting(:)
        integer, intent(in) :: k
        !> Of its node, and the size of that
        real(wp), intent(in) :: deflection, deflection_size
        logical, intent(out) :: acts, rigid
        real(wp), intent(out) :: force, rounding
        real(wp) :: slope

        force = 0.0_wp
        rounding = 0.0_wp
        rigid = .false.
        associate (s => supports(k))
            if (s%breakpoint > 0) then
                call piece_that_acts(supports, acting, k, acts, slope)
                if (.not. acts) return
                rigid = abs(slope) > huge(slope)
                if (.not. rigid) call piece_force(s, slope, deflection, deflection_size, force, rounding)
            else
                acts = acting(k)
                if (.not. acts) return
                rigid = is_rigid(s)
                if (rigid) return
                force = s%stiffness*(deflection - s%contact) + 0.0_wp   ! no negative zero
                rounding = epsilon(1.0_wp)*s%stiffness*max(deflection_size, abs(s%contact))
            end if
        end associate
    end subroutine force_by_spring

    !> Is a support without breakpoints on its law, in the right state, but for rounding. What is not so at a glance may still be so
    pure function is_plainly_right(support, closed, deflection, deflection_size, reaction, force_size, limit) result(right)
        type(node_support_type), intent(in) :: support
        logical, intent(in) :: closed
        !> Of its node, and the size of that for rounding errors
        real(wp), intent(in) :: deflection, deflection_size
        !> Its reaction, and the size of the forces at its node
        real(wp), intent(in) :: reaction, force_size
        !> Share of the terms that may be left over
        real(wp), intent(in) :: limit
        logical :: right

        right = .false.
        if (support%breakpoint > 0) return
        if (.not. closed) then
            right = .not. abs(reaction) > 0.0_wp .and. support%side*(support%contact - deflection) >= 0.0_wp
        else if (support%side*reaction >= 0.0_wp) then
            if (is_rigid(support)) then
                right = abs(deflection - support%contact) <= limit*abs(support%contact)
            else
                right = abs(reaction - support%stiffness*(deflection - support%contact)) &
                    <= limit*(support%stiffness*(deflection_size + abs(support%contact)) + force_size)
            end if
        end if
    end function is_plainly_right

end module gapbeam_law

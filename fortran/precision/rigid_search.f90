!> Where a beam touches rigid ground, to begin with: from places at which it is stopped, as close to each other as a mesh.
!> There is an equilibrium on these if there is one on the ground, since a beam that moves freely stays straight between its nodes.
module gapbeam_rigid_search
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: first_rigid_parts
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_ground_laws, only: between
    use gapbeam_ground, only: ground_type
    use gapbeam_rigid_contact, only: contact_type, binding_layer, same_line
    use gapbeam_rigid_order, only: put_in_order
    use gapbeam_rigid_state, only: rigid_type
    use gapbeam_rigid_held, only: solve_held
    implicit none
    private
    public :: touch_on_mesh

    !> A zone and what is touched so many places farther on are one: at the ends of zones some places are not touched
    integer, parameter :: widest_gap = 4

    !> Places along a piece at which the beam may touch a layer, from left to right: distance from its left end, whether it does,
    !> and how the ground pushes there
    type :: row_type
        integer :: number = 0
        real(wp), allocatable :: at(:), push(:)
        logical, allocatable :: touches(:)
    end type row_type

contains

    !> Contacts on a mesh
    subroutine touch_on_mesh(ground, factor, rule, finer, closed, contacts, solves, outcome, error)
        type(ground_type), intent(in) :: ground
        !> Load factor, and rule for the supports (gapbeam_search)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> How many times finer than the first mesh
        integer, intent(in) :: finer
        !> States of the supports: start in, found out
        logical, intent(inout) :: closed(:)
        !> Those of the last mesh, with which the search begins, in, if there was one; out zones where the beam touches at three
        !> places in a row or more, and single places
        type(contact_type), allocatable, intent(inout) :: contacts(:)
        !> Linear solves so far
        integer, intent(inout) :: solves
        !> Solved or no equilibrium, with the motion of the nodes of the beam without ground
        type(outcome_type), intent(out) :: outcome
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        type(rigid_type) :: rigid
        real(wp), allocatable :: motion(:)

        call list_places(ground, finer, rigid%contacts)
        call solve_held(ground, factor, rule, rigid, closed, outcome, error, near_contacts(ground, rigid%contacts, contacts))
        solves = solves + rigid%solves
        if (allocated(error)) return
        if (allocated(contacts)) deallocate (contacts)
        if (outcome%status == gapbeam_solved) then
            call join_places(ground, rigid, contacts)
        else if (allocated(outcome%motion)) then
            allocate (motion(0:size(ground%pieces)), source=outcome%motion(rigid%grounded%node))
            call move_alloc(motion, outcome%motion)
        end if
    end subroutine touch_on_mesh

    !> Which places are near contacts; all where there are none yet
    pure function near_contacts(ground, places, contacts) result(near)
        type(ground_type), intent(in) :: ground
        type(contact_type), intent(in) :: places(:)
        type(contact_type), allocatable, intent(in) :: contacts(:)
        logical :: near(size(places))
        real(wp) :: from(size(ground%pieces)), margin
        integer :: c, j

        near(:) = .true.
        if (.not. allocated(contacts)) return
        near(:) = .false.
        from(1) = 0.0_wp
        do j = 2, size(from)
            from(j) = from(j - 1) + ground%pieces(j - 1)%length
        end do
        margin = sum(ground%pieces%length)/first_rigid_parts/8
        do c = 1, size(contacts)
            associate (here => from(places%piece) + places%from, start => from(contacts(c)%piece))
                near = near .or. (here > start + contacts(c)%from - margin .and. here < start + contacts(c)%to + margin)
            end associate
        end do
    end function near_contacts

    !> Places at which the beam may touch: all nodes over the ground, and places between, one hold each
    pure subroutine list_places(ground, finer, places)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: finer
        type(contact_type), allocatable, intent(out) :: places(:)
        integer :: parts(size(ground%pieces)), j, k, n, p
        real(wp) :: length, at

        length = sum(ground%pieces%length, mask=ground%first(2:) > ground%first(:size(ground%pieces)))
        parts(:) = finer*max(4, ceiling(min(1.0_wp, ground%pieces%length/length)*first_rigid_parts))
        allocate (places(sum((parts + 1)*(ground%first(2:) - ground%first(:size(parts))))))
        n = 0
        do j = 1, size(parts)
            do p = 0, parts(j)
                do k = ground%first(j), ground%first(j + 1) - 1
                    if (p == 0 .and. binding_layer(ground, j - 1, ground%layers(k)%side) /= k) cycle
                    if (p == parts(j) .and. binding_layer(ground, j, ground%layers(k)%side) /= k) cycle
                    n = n + 1
                    at = between(0.0_wp, ground%pieces(j)%length, p, parts(j))
                    places(n) = contact_type(j, k, at, at)
                end do
            end do
        end do
        places = places(:n)
    end subroutine list_places

    !> Where the beam touches at places in a row it lies in a zone; where at two of them, it touches between
    subroutine join_places(ground, rigid, contacts)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        type(contact_type), allocatable, intent(out) :: contacts(:)
        type(row_type) :: row
        integer :: j, k, n, p, begins

        allocate (contacts(size(rigid%contacts)))
        allocate (row%at(size(contacts) + 2), row%push(size(contacts) + 2), row%touches(size(contacts) + 2))
        n = 0
        begins = 1
        do j = 1, size(ground%pieces)
            do while (begins <= size(contacts))
                if (rigid%contacts(begins)%piece >= j) exit
                begins = begins + 1
            end do
            do k = ground%first(j), ground%first(j + 1) - 1
                row%number = 0
                call take_node(ground, rigid, j, k, j - 1, row)
                do p = begins, size(contacts)
                    if (rigid%contacts(p)%piece > j) exit
                    if (rigid%contacts(p)%layer == k) call take(rigid, p, rigid%contacts(p)%from, row)
                end do
                call take_node(ground, rigid, j, k, j, row)
                call join_row(contact_type(j, k), ground%pieces(j)%length, row, contacts, n)
            end do
        end do
        call put_in_order(contacts, n)
    end subroutine join_places

    !> One more place of a row
    subroutine take(rigid, place, distance, row)
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: place
        real(wp), intent(in) :: distance
        type(row_type), intent(inout) :: row

        row%number = row%number + 1
        row%at(row%number) = distance
        row%touches(row%number) = rigid%touching(place)
        row%push(row%number) = rigid%push(place)
    end subroutine take

    !> The place at a node, where that is one of the piece beside it and the ground is the same line there
    subroutine take_node(ground, rigid, piece, layer, node, row)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: piece, layer, node
        type(row_type), intent(inout) :: row
        integer :: binding, place, pair(2)

        binding = binding_layer(ground, node, ground%layers(layer)%side)
        if (binding >= ground%first(piece) .and. binding < ground%first(piece + 1)) return
        pair = merge([binding, layer], [layer, binding], node < piece)
        if (.not. same_line(ground, node, pair)) return
        do place = 1, size(rigid%contacts)
            associate (contact => rigid%contacts(place))
                if (contact%layer /= binding) cycle
                if (node < piece .and. contact%from < ground%pieces(node)%length) cycle
                if (node == piece .and. contact%from > 0.0_wp) cycle
            end associate
            call take(rigid, place, merge(ground%pieces(piece)%length, 0.0_wp, node == piece), row)
            exit
        end do
    end subroutine take_node

    !> Zones and single places of a row
    subroutine join_row(here, length, row, contacts, n)
        !> Piece and layer, and the length of the piece
        type(contact_type), intent(in) :: here
        real(wp), intent(in) :: length
        type(row_type), intent(in) :: row
        !> The first n are there
        type(contact_type), intent(inout) :: contacts(:)
        integer, intent(inout) :: n
        type(contact_type) :: this
        integer :: first, last, before
        logical :: is_zone, is_near

        before = -widest_gap
        is_zone = .false.
        first = 1
        do while (first <= row%number)
            if (.not. row%touches(first)) then
                first = first + 1
                cycle
            end if
            last = first
            do while (last < row%number)
                if (.not. row%touches(last + 1)) exit
                last = last + 1
            end do
            this = here
            this%from = row%at(first)
            this%to = row%at(last)
            if (last == first + 1) then
                this%from = between_two(row, first, length)
                this%to = this%from
            end if
            is_near = first - before <= widest_gap .and. before > 0
            if (is_near .and. (is_zone .or. this%to > this%from)) then
                contacts(n)%to = this%to
                is_zone = .true.
            else
                n = n + 1
                contacts(n) = this
                is_zone = this%to > this%from
            end if
            before = last
            first = last + 1
        end do
    end subroutine join_row

    !> Where the beam touches between two places: at a node if one is there
    pure function between_two(row, first, length) result(place)
        type(row_type), intent(in) :: row
        integer, intent(in) :: first
        real(wp), intent(in) :: length
        real(wp) :: place, sum_of_both

        associate (a => row%at(first), b => row%at(first + 1))
            sum_of_both = row%push(first) + row%push(first + 1)
            place = (a + b)/2
            if (abs(sum_of_both) > 0.0_wp) place = a + (b - a)*row%push(first + 1)/sum_of_both
            if (b >= length) place = b
            if (a <= 0.0_wp) place = a
        end associate
    end function between_two

end module gapbeam_rigid_search

!> Contacts with rigid ground in order from left to right, joined where they overlap, and apart where the ground has corners.
module gapbeam_rigid_order
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_level
    use gapbeam_ground, only: ground_type
    use gapbeam_rigid_contact, only: contact_type, binding_layer, same_line
    implicit none
    private
    public :: put_in_order

contains

    !> From left to right; what touches in a zone of the same side belongs to that, and zones that meet in a piece are one
    subroutine put_in_order(ground, found, n)
        type(ground_type), intent(in) :: ground
        type(contact_type), allocatable, intent(inout) :: found(:)
        integer, intent(in) :: n
        type(contact_type) :: this
        integer :: i, k, m

        do i = 2, n
            this = found(i)
            k = i - 1
            do while (k > 0)
                if (.not. comes_before(this, found(k))) exit
                found(k + 1) = found(k)
                k = k - 1
            end do
            found(k + 1) = this
        end do
        m = 0
        do i = 1, n
            this = found(i)
            if (m > 0) then
                associate (last => found(m))
                    if (last%piece == this%piece .and. this%from <= last%to) then
                        if (last%layer == this%layer) last%to = max(last%to, this%to)
                        if (last%layer == this%layer .or. last%to > last%from) cycle
                    end if
                end associate
            end if
            m = m + 1
            found(m) = this
        end do
        found = found(:m)
        call part_at_kinks()

    contains

        !> A zone keeps away from a node where the ground has a kink or a step, unless it lies on its own there
        subroutine part_at_kinks()
            integer :: i
            real(wp) :: length

            do i = 1, size(found)
                associate (a => found(i))
                    length = a%to - a%from
                    if (.not. length > 0.0_wp) cycle
                    if (a%from <= 0.0_wp) then
                        if (is_stopped(a, a%piece - 1)) a%from = a%from + length/4
                    end if
                    if (a%to >= ground%pieces(a%piece)%length) then
                        if (is_stopped(a, a%piece)) a%to = a%to - length/4
                    end if
                end associate
            end do
        end subroutine part_at_kinks

        !> Does other ground stop the beam at a node sooner, or a zone begin there that goes another way
        pure function is_stopped(zone, node) result(stops)
            type(contact_type), intent(in) :: zone
            integer, intent(in) :: node
            logical :: stops
            integer :: i, binding, other, beyond(2)

            stops = .false.
            other = zone%piece + merge(1, -1, node == zone%piece)
            if (other < 1 .or. other > size(ground%pieces)) return
            binding = binding_layer(ground, node, ground%layers(zone%layer)%side)
            do i = 1, size(found)
                associate (b => found(i))
                    if (b%piece /= other .or. .not. b%to > b%from) cycle
                    if (merge(b%from > 0.0_wp, b%to < ground%pieces(other)%length, other > node)) cycle
                    beyond = merge([zone%layer, b%layer], [b%layer, zone%layer], other > node)
                    stops = stops .or. .not. same_line(ground, node, beyond)
                end associate
            end do
            if (binding >= ground%first(zone%piece) .and. binding < ground%first(zone%piece + 1)) return
            beyond = merge([zone%layer, binding], [binding, zone%layer], other > node)
            stops = stops .or. .not. meets(beyond)
        end function is_stopped

        !> Are two layers equally high where their pieces meet
        pure function meets(layers)
            !> Left and right of the node
            integer, intent(in) :: layers(2)
            logical :: meets

            associate (a => ground%layers(layers(1))%contact_b, b => ground%layers(layers(2))%contact_a)
                meets = abs(a - b) <= same_level*max(abs(a), abs(b))
            end associate
        end function meets

    end subroutine put_in_order

    !> The order of contacts: longer zones first where they begin at one place
    pure function comes_before(a, b) result(before)
        type(contact_type), intent(in) :: a, b
        logical :: before

        if (a%piece /= b%piece) then
            before = a%piece < b%piece
        else if (abs(a%from - b%from) > 0.0_wp) then
            before = a%from < b%from
        else
            before = a%to > b%to
        end if
    end function comes_before

end module gapbeam_rigid_order

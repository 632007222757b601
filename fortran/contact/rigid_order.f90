!> Contacts with rigid ground in order from left to right, joined where they overlap.
module gapbeam_rigid_order
    use gapbeam_kinds, only: wp
    use gapbeam_rigid_contact, only: contact_type
    implicit none
    private
    public :: put_in_order

contains

    !> From left to right; what touches in a zone of the same side belongs to that, and zones that meet in a piece are one
    pure subroutine put_in_order(found, n)
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

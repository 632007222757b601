!> Numbers that left the range of double precision, by overflow or underflow.
module gapbeam_range
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type, piece_type
    implicit none
    private
    public :: is_lost, first_lost_link

contains

    !> Has a number above 0 left the range in which it has all its digits
    elemental function is_lost(value) result(lost)
        real(wp), intent(in) :: value
        logical :: lost

        lost = .not. (value >= tiny(value) .and. value <= huge(value))
    end function is_lost

    !> The first link, from 1, whose flexibilities lost digits; with a minus the first whose loads are no numbers; 0: none
    pure function first_lost_link(pieces, links, last) result(lost)
        !> Pieces of the beam, its links, and the last piece of every link
        type(piece_type), intent(in) :: pieces(:)
        type(link_type), intent(in) :: links(:)
        integer, intent(in) :: last(:)
        integer :: lost, first

        first = 1
        do lost = 1, size(links)
            associate (l => links(lost), p => pieces(first:last(lost)))
                if (is_lost(l%length) .or. is_lost(l%inverse)) return
                if (any(p%flexibility > 0.0_wp)) then
                    if (is_lost(l%bending) .or. is_lost(l%determinant)) return
                end if
                if (any(p%shear_flexibility > 0.0_wp)) then
                    if (is_lost(l%faa)) return
                end if
                if (.not. all(abs([l%faa, l%fab, l%fbb]) <= huge(l%faa))) return
            end associate
            first = last(lost) + 1
        end do
        do lost = -1, -size(links), -1
            associate (l => links(-lost))
                if (.not. all(abs([l%turn_a, l%turn_b, l%shear_a, l%shear_b, l%load_sum, l%turn_sum]) <= huge(l%faa))) return
            end associate
        end do
        lost = 0
    end function first_lost_link

end module gapbeam_range

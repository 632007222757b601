!> How far a change of some links is felt along the chain.
module gapbeam_axial_reach
    use gapbeam_kinds, only: qp
    use gapbeam_axial_chain, only: chain_type
    implicit none
    private
    public :: find_reaches

contains

    !> Parts of the chain in which the rates change with the pieces of some links, or with their limits: first and last point
    pure function find_reaches(chain, links) result(reaches)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: links(:)
        !> From no part to another one, shape (2, *)
        integer, allocatable :: reaches(:, :)
        integer :: parts(2, size(links)), reach(2), number, i, k

        if (chain%loose .or. .not. chain%by_parts) then
            reaches = reshape(find_reach(chain, links), [2, 1])
            return
        end if
        number = 0
        do i = 1, size(links)
            associate (node => chain%laws(chain%first(links(i)))%node)
                if (any(parts(1, :number) < node .and. node < parts(2, :number))) cycle
            end associate
            reach = find_reach(chain, links(i:i))
            k = 1
            do while (k <= number)
                if (max(parts(1, k), reach(1)) < min(parts(2, k), reach(2))) then
                    reach = [min(parts(1, k), reach(1)), max(parts(2, k), reach(2))]
                    parts(:, k) = parts(:, number)
                    number = number - 1
                    k = 0
                end if
                k = k + 1
            end do
            number = number + 1
            parts(:, number) = reach
        end do
        reaches = parts(:, :number)
    end function find_reaches

    !> Points between which the rates change with the pieces of some links: as far as the nearest rigid links that stay
    pure function find_reach(chain, links) result(reach)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: links(:)
        integer :: reach(2), l

        ! Laws that keep a set follow the beam wherever it goes, and what moves by itself takes friction along
        reach = [0, size(chain%flexibility)]
        if (chain%loose) return
        if (.not. chain%by_parts) then
            if (any(chain%keeps_set) .or. any(abs(chain%own_rate) > 0.0_qp)) return
        end if
        reach = reach([2, 1])
        do l = 1, size(links)
            associate (node => chain%laws(chain%first(links(l)))%node)
                reach = [min(reach(1), node), max(reach(2), node)]
            end associate
        end do
        reach = [max(0, reach(1) - 1), min(size(chain%flexibility), reach(2) + 1)]
        do while (reach(1) > 0)
            if (chain%holder(reach(1)) > 0) exit
            reach(1) = reach(1) - 1
        end do
        do while (reach(2) < size(chain%flexibility))
            if (chain%holder(reach(2)) > 0) exit
            reach(2) = reach(2) + 1
        end do
    end function find_reach

end module gapbeam_axial_reach

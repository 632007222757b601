!> Pieces of the links as the solver of eight cases takes them (fortran/cases, files lane_*)
module gapbeam_lane_pieces
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: sum_type, add, total
    use gapbeam_link, only: piece_load_type, no_load
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_loads, only: find_loaded, put_load
    use gapbeam_lane_types, only: lane_pieces_type
    implicit none
    private
    public :: prepare_pieces

contains

    !> Pieces of the links, and what the loads with factor 1 put on them
    subroutine prepare_pieces(assembled, extent, pieces, made)
        type(assembled_type), intent(in) :: assembled
        !> Numbers that follow from stiffnesses: 1 where all cases have the same, or lanes
        integer, intent(in) :: extent
        type(lane_pieces_type), intent(out) :: pieces
        !> False where memory ends
        logical, intent(out) :: made
        type(piece_load_type), allocatable :: on_pieces(:)
        integer :: first, j, k, last, n, node, shares, stat

        n = size(assembled%pieces)
        shares = 0
        do k = 1, size(assembled%model%loads)
            call find_loaded(assembled, k, first, last, node)
            shares = shares + max(last - first + 1, 0)
        end do
        allocate (pieces%last(0:size(assembled%beam%links)), pieces%length(n), pieces%flexibility(extent, n), &
                  pieces%shear_flexibility(extent, n), &
                  pieces%before(n), pieces%behind(n), pieces%number(n), pieces%half(n), pieces%load(shares), &
                  pieces%piece(shares), pieces%to_piece(5, shares), &
                  on_pieces(n), stat=stat)
        made = stat == 0
        if (.not. made) return
        pieces%last(:) = assembled%node_point
        pieces%length(:) = assembled%pieces%length
        pieces%half(:) = 0.5_wp*pieces%length
        pieces%number(:) = [(j, j=1, n)]
        pieces%flexibility(:, :) = spread(assembled%pieces%flexibility, 1, extent)
        pieces%shear_flexibility(:, :) = spread(assembled%pieces%shear_flexibility, 1, extent)
        do k = 1, ubound(pieces%last, 1)
            call find_distances(pieces%last(k - 1) + 1, pieces%last(k))
        end do
        on_pieces(:) = no_load
        shares = 0
        do k = 1, size(assembled%model%loads)
            call put_load(assembled, k, first, last, node, on_pieces)
            do j = first, last
                shares = shares + 1
                pieces%load(shares) = k
                pieces%piece(shares) = j
                associate (q => on_pieces(j))
                    pieces%to_piece(:, shares) = [q%qa, q%qb, q%kappa, q%force, q%couple]
                end associate
                on_pieces(j) = no_load
            end do
        end do

    contains

        !> Distances of the pieces of a link from its ends
        subroutine find_distances(first, last)
            integer, intent(in) :: first, last
            type(sum_type) :: sum
            integer :: i

            sum = sum_type()
            do i = first, last
                pieces%before(i) = total(sum)
                call add(sum, pieces%length(i))
            end do
            sum = sum_type()
            do i = last, first, -1
                pieces%behind(i) = total(sum)
                call add(sum, pieces%length(i))
            end do
        end subroutine find_distances

    end subroutine prepare_pieces

end module gapbeam_lane_pieces

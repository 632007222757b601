!> Pieces of the links as the solver of eight cases takes them (fortran/cases, files lane_*)
module gapbeam_lane_pieces
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: sum_type, add, total
    use gapbeam_link, only: piece_load_type
    use gapbeam_scene, only: gapbeam_force, gapbeam_couple, gapbeam_axial_force
    use gapbeam_assembled_model, only: assembled_type, is_stretch
    use gapbeam_assemble_loads, only: spread_load
    use gapbeam_assemble_units, only: load_in_units
    use gapbeam_lane_types, only: lane_pieces_type
    implicit none
    private
    public :: prepare_pieces

    !> No load on a piece
    type(piece_load_type), parameter :: no_load = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)

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
        integer :: j, k, n, shares, stat

        n = size(assembled%pieces)
        shares = 0
        do k = 1, size(assembled%model%loads)
            if (is_stretch(assembled%model%loads(k))) then
                shares = shares + assembled%load_to(k) - assembled%load_from(k)
            else if (is_inside(k)) then
                shares = shares + 1
            end if
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
            associate (load => assembled%model%loads(k), a => assembled%load_from(k), b => assembled%load_to(k))
                if (is_stretch(load)) then
                    call spread_load(assembled, load, a, b, on_pieces)
                    do j = a + 1, b
                        call take(j)
                    end do
                else if (is_inside(k)) then
                    if (load%kind == gapbeam_force) on_pieces(a)%force = load%value
                    if (load%kind == gapbeam_couple) on_pieces(a)%couple = load%value
                    call take(a)
                end if
            end associate
        end do

    contains

        !> Does a load act at a point that is no node
        pure function is_inside(load) result(yes)
            integer, intent(in) :: load
            logical :: yes

            yes = .not. is_stretch(assembled%model%loads(load)) .and. assembled%model%loads(load)%kind /= gapbeam_axial_force
            if (yes) yes = assembled%node_of_point(assembled%load_from(load)) < 0
        end function is_inside

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

        !> Keep what the load at hand puts on a piece
        subroutine take(piece)
            integer, intent(in) :: piece

            call load_in_units(on_pieces(piece), assembled%units)
            shares = shares + 1
            pieces%load(shares) = k
            pieces%piece(shares) = piece
            associate (q => on_pieces(piece))
                pieces%to_piece(:, shares) = [q%qa, q%qb, q%kappa, q%force, q%couple]
            end associate
            on_pieces(piece) = no_load
        end subroutine take

    end subroutine prepare_pieces

end module gapbeam_lane_pieces

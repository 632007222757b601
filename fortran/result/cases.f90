!> Many load cases of one beam. What each load does alone is condensed once; a case is a sum of that, each load times a factor.
module gapbeam_cases
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_link, only: link_type, load_type, piece_type, condense_loads
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, set_loads
    use gapbeam_scheme, only: outcome_type
    use gapbeam_referee, only: decide_scheme, detail_type
    implicit none
    private
    public :: share_type, node_share_type, condense_shares, solve_case

    !> What a load does to a link: rotations and shears of the simple bar, sums of absolute values (link_type)
    type, bind(c) :: share_type
        real(wp) :: turn_a, turn_b, shear_a, shear_b, load_sum, turn_sum
    end type share_type

    !> What a load does to a node: force (down) and couple (clockwise)
    type, bind(c) :: node_share_type
        real(wp) :: force, couple
    end type node_share_type

contains

    !> Condense loads one by one
    pure subroutine condense_shares(pieces, links, last, load, piece, values, number, share_load, share_link, shares)
        !> Pieces of the beam, its links, and the last piece of every link
        type(piece_type), intent(in) :: pieces(:)
        type(link_type), intent(in) :: links(:)
        integer, intent(in) :: last(:)
        !> Rows in order of load, then piece: number of the load, piece, and what of the load is on it
        integer, intent(in) :: load(:), piece(:)
        type(load_type), intent(in) :: values(:)
        !> How many shares there are; load and link of each, shape (size(load))
        integer, intent(out) :: number
        integer, intent(out) :: share_load(:), share_link(:)
        type(share_type), intent(out) :: shares(:)
        type(load_type), allocatable :: loads(:)
        real(wp), allocatable :: work(:)
        integer, allocatable :: link_of(:), first_of(:)
        type(link_type) :: link
        integer :: row, end_row, i, first

        allocate (loads(size(pieces)), work(size(pieces)), link_of(size(pieces)), first_of(size(last)))
        loads(:) = load_type(0, 0, 0, 0, 0)
        first = 1
        do i = 1, size(last)
            first_of(i) = first
            link_of(first:last(i)) = i
            first = last(i) + 1
        end do
        number = 0
        share_load = 0
        share_link = 0
        shares = share_type(0, 0, 0, 0, 0, 0)
        row = 1
        do while (row <= size(load))
            i = link_of(piece(row))
            link = links(i)
            first = first_of(i)
            end_row = row
            loads(piece(row)) = values(row)
            do while (end_row < size(load))
                if (load(end_row + 1) /= load(row) .or. link_of(piece(end_row + 1)) /= i) exit
                end_row = end_row + 1
                loads(piece(end_row)) = values(end_row)
            end do
            call condense_loads(pieces(first:last(i)), loads(first:last(i)), link, 1, work)
            loads(piece(row:end_row)) = load_type(0, 0, 0, 0, 0)
            number = number + 1
            share_load(number) = load(row)
            share_link(number) = i
            shares(number) = share_type(link%turn_a(1), link%turn_b(1), link%shear_a(1), link%shear_b(1), link%load_sum(1), &
                                        link%turn_sum(1))
            row = end_row + 1
        end do
    end subroutine condense_shares

    !> Find the working scheme of a case and solve it
    subroutine solve_case(factors, share_load, share_link, shares, node_load, node, node_shares, rule, beam, closed, work, &
                          status)
        !> Factor of every load
        real(wp), intent(in) :: factors(:)
        !> Shares of the loads in links, by condense_shares, and in nodes: load, link or node, values
        integer, intent(in) :: share_load(:), share_link(:)
        type(share_type), intent(in) :: shares(:)
        integer, intent(in) :: node_load(:), node(:)
        type(node_share_type), intent(in) :: node_shares(:)
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> The beam; its loads are replaced
        type(beam_type), intent(inout) :: beam
        !> Start in, working scheme out
        logical, intent(inout) :: closed(:)
        !> Workspace of the beam in, solution out
        type(workspace_type), intent(inout) :: work
        !> gapbeam_solved, gapbeam_no_equilibrium or the code of an error
        integer, intent(out) :: status
        type(detail_type) :: links_only
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        integer :: i, k

        do i = 1, size(beam%links)
            associate (link => beam%links(i))
                link%turn_a = 0.0_wp
                link%turn_b = 0.0_wp
                link%shear_a = 0.0_wp
                link%shear_b = 0.0_wp
                link%load_sum = 0.0_wp
                link%turn_sum = 0.0_wp
            end associate
        end do
        beam%force = 0.0_wp
        beam%couple = 0.0_wp
        do k = 1, size(shares)
            associate (link => beam%links(share_link(k)), s => shares(k), factor => factors(share_load(k)))
                link%turn_a(2) = link%turn_a(2) + factor*s%turn_a
                link%turn_b(2) = link%turn_b(2) + factor*s%turn_b
                link%shear_a(2) = link%shear_a(2) + factor*s%shear_a
                link%shear_b(2) = link%shear_b(2) + factor*s%shear_b
                link%load_sum(2) = link%load_sum(2) + abs(factor)*s%load_sum
                link%turn_sum(2) = link%turn_sum(2) + abs(factor)*s%turn_sum
            end associate
        end do
        do k = 1, size(node)
            associate (factor => factors(node_load(k)))
                beam%force(2, node(k)) = beam%force(2, node(k)) + factor*node_shares(k)%force
                beam%couple(2, node(k)) = beam%couple(2, node(k)) + factor*node_shares(k)%couple
            end associate
        end do
        call set_loads(beam, 1.0_wp, work)
        call decide_scheme(beam, links_only, 1.0_wp, rule, closed, work, outcome, error)
        status = outcome%status
        if (allocated(error)) status = error%code
    end subroutine solve_case

end module gapbeam_cases

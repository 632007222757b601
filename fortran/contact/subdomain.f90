!> A stretch of the beam cut out as a beam of its own (Schwarz).
module gapbeam_subdomain
    use gapbeam_kinds, only: wp, dp
    use gapbeam_limits, only: least_margin_nodes
    use gapbeam_tolerances, only: subdomain_lengths
    use gapbeam_require, only: checked, require
    use gapbeam_band, only: plain
    use gapbeam_law, only: node_support_type
    use gapbeam_law_adapters, only: stiffness_of_changing, hold_both_ways
    use gapbeam_model, only: beam_type, order_supports
    use gapbeam_workspace, only: workspace_type, new_workspace
    implicit none
    private
    public :: next_stretch, extract_subdomain, least_margin

contains

    !> Nodes to be taken along with a subdomain at first; 0 where supports are so soft that all at once are changed better
    pure function least_margin(beam) result(margin)
        type(beam_type), intent(in) :: beam
        integer :: margin
        real(wp), allocatable :: stiffness(:)
        real(wp) :: felt, bending
        integer :: k, count
        ! Roots are taken in double precision, which needs no library for quadruple
        real(wp), parameter :: largest = 1e300_wp

        felt = 0.0_wp
        count = 0
        allocate (stiffness(size(beam%supports)), source=stiffness_of_changing(beam%supports))
        do k = 1, size(stiffness)
            if (.not. stiffness(k) > 0.0_wp) cycle
            count = count + 1
            associate (link => beam%links(max(1, beam%supports(k)%node)))
                bending = link%bending*link%length**2
                ! (4 EI/k)**(1/4), k = stiffness/length, in lengths of the link (Hetenyi 1946)
                if (.not. bending > 0.0_wp .or. stiffness(k) > huge(bending)) cycle
                felt = felt + min(real(size(beam%links), dp), sqrt(sqrt(real(min(4/(bending*stiffness(k)), largest), dp))))
            end associate
        end do
        margin = max(least_margin_nodes, int(sqrt(real(size(beam%links), dp))))
        if (subdomain_lengths*felt > margin*count) margin = 0
    end function least_margin

    !> The next stretch around supports, from left to right
    pure subroutine next_stretch(beam, chosen, margin, place, from, to)
        type(beam_type), intent(in) :: beam
        !> The supports
        logical, intent(in) :: chosen(:)
        !> Nodes to be taken along on both sides
        integer, intent(in) :: margin
        !> Place in order at which to look on, 1 at first
        integer, intent(inout) :: place
        !> First and last node; from < 0 if there is no further stretch
        integer, intent(out) :: from, to
        integer :: node

        from = -1
        to = -1
        do while (place <= size(chosen))
            node = beam%supports(beam%order(place))%node
            if (chosen(beam%order(place))) then
                if (from >= 0 .and. node > to + margin) return
                if (from < 0) from = max(0, node - margin)
                to = min(node + margin, size(beam%links))
            end if
            place = place + 1
        end do
    end subroutine next_stretch

    !> Cut the beam at two nodes. What the rest does to the stretch becomes loads at its ends; the two outermost supports
    !> at a cut hold both ways if they are closed, so that the stretch stays in its place
    pure subroutine extract_subdomain(beam, closed, work, from, to, subdomain, subdomain_work, number)
        !> The beam and a scheme solved in work
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> First and last node of the stretch
        integer, intent(in) :: from, to
        !> The stretch, its loads in its own workspace
        type(beam_type), intent(out) :: subdomain
        type(workspace_type), intent(out) :: subdomain_work
        !> Numbers of its supports in the whole beam
        integer, allocatable, intent(out) :: number(:)
        type(node_support_type), allocatable :: supports(:)
        integer :: m, j, k

        m = to - from
        if (checked) call require(0 <= from .and. from < to .and. to <= size(beam%links), "extract_subdomain: from, to")
        allocate (subdomain%links(m), subdomain%kind(0:m), subdomain%compliance(0:m), subdomain%force(2, 0:m), &
                  subdomain%couple(2, 0:m))
        subdomain%watch = beam%watch
        subdomain%links(:) = beam%links(from + 1:to)
        subdomain%kind(:) = beam%kind(from:to)
        subdomain%compliance(:) = beam%compliance(from:to)
        subdomain%force(:, :) = beam%force(:, from:to)
        subdomain%couple(:, :) = beam%couple(:, from:to)
        associate (there => beam%order(beam%first(from):beam%first(to + 1) - 1))
            allocate (number, source=there)
        end associate
        ! In the caller's order
        do k = 2, size(number)
            if (number(k) > number(k - 1)) cycle
            number(:) = pack([(j, j=1, size(closed))], beam%supports%node >= from .and. beam%supports%node <= to)
            exit
        end do
        supports = beam%supports(number)
        supports%node = supports%node - from
        call order_supports(supports, subdomain)
        call new_workspace(subdomain, subdomain_work)
        subdomain_work%loads(:) = work%loads(from:to)
        subdomain_work%load_size(:) = work%load_size(from:to)
        subdomain_work%turn_size(:) = work%turn_size(from + 1:to)
        subdomain_work%proximal_weight(:) = work%proximal_weight(from:to)
        subdomain_work%reference(:) = work%reference(from:to)
        if (from > 0) then
            subdomain%kind(0) = plain
            associate (first => subdomain_work%loads(0))
                first%left = 0.0_wp
                first%couple = work%answers(from)%moment_right
                first%shear = first%shear - work%shear(from)
            end associate
            call hold_closed_ones(subdomain, closed(number), 0, 1)
        end if
        if (to < size(beam%links)) then
            subdomain%kind(m) = plain
            associate (last => subdomain_work%loads(m))
                last%right = 0.0_wp
                last%couple = -work%answers(to)%moment_left
                last%shear = last%shear + work%shear(to + 1)
            end associate
            call hold_closed_ones(subdomain, closed(number), m - 1, m)
        end if
    end subroutine extract_subdomain

    !> Let the closed supports of some nodes hold both ways
    pure subroutine hold_closed_ones(subdomain, closed, first, last)
        type(beam_type), intent(inout) :: subdomain
        !> The scheme of the subdomain
        logical, intent(in) :: closed(:)
        integer, intent(in) :: first, last
        integer :: j

        do j = subdomain%first(first), subdomain%first(last + 1) - 1
            if (closed(subdomain%order(j))) call hold_both_ways(subdomain%supports(subdomain%order(j)))
        end do
    end subroutine hold_closed_ones

end module gapbeam_subdomain

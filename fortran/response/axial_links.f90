!> Links along the beam that act one way or by a law, where bending feels the axial force: the way of the chain with the load.
!>
!> Slopes are small, so bending does not change the forces of the chain, which is followed for itself: the dead loads first, then
!> the live ones. Between two changes of its links axial forces grow straight with the load factor.
module gapbeam_axial_links
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_units, only: rotation_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_walk, only: chain_walk_type, begin_walk, set_loads, go_to, numbers_of
    use gapbeam_pieces, only: acting_type, acting_piece, what_happens, no_change, gapbeam_slips, gapbeam_sticks
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: links_type, follow_links, take_links, tensions_of_links, take_numbers, link_change_type, changes_along

    !> The way of a chain from load factor 0 on, in stretches on which its links stay on their pieces
    type, extends(chain_walk_type) :: links_type
        integer :: number = 0
        !> Load factors at which stretches begin and end, shape (2, at least number)
        real(wp), allocatable :: ends(:, :)
        !> Numbers of the chain (numbers_of) there, and the scheme of its links, their last sizes as that
        real(wp), allocatable :: numbers(:, :, :)
        logical, allocatable :: closed(:, :)
    contains
        procedure :: keep
    end type links_type

    !> What happens to a link
    type :: link_change_type
        !> Support of the model; the event (gapbeam_pieces), and what acts after it
        integer :: support, change, condition
    end type link_change_type

contains

    !> Follow the chain under the dead loads, then the live ones up to a load factor
    subroutine follow_links(assembled, to, links, error)
        !> With links along the beam of which none rubs
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: to
        !> lost where the chain moves without end before
        type(links_type), intent(out) :: links
        !> As for go_to
        type(error_type), allocatable, intent(out) :: error

        call begin_walk(assembled, links)
        associate (n => 2*size(links%chain%flexibility) + 1 + size(links%support), m => size(links%chain%laws))
            allocate (links%ends(2, 8), links%numbers(n, 2, 8), links%closed(m, 8))
        end associate
        call set_loads(assembled, 0, 1.0_wp, links)
        associate (chain => links%chain)
            if (any(abs(chain%load_rate) > 0.0_qp) .or. any(abs(chain%elongation_rate) > 0.0_qp) &
                .or. any(abs(chain%own_rate) > 0.0_qp)) call go_to(links, assembled, 0.0_qp, 1.0_qp, error)
        end associate
        links%number = 0
        if (links%lost) links%lost_at = 0.0_wp
        if (allocated(error) .or. links%lost) return
        call set_loads(assembled, 1, sign(1.0_wp, to), links)
        call go_to(links, assembled, 0.0_qp, real(to, qp), error)
    end subroutine follow_links

    !> Keep a stretch
    subroutine keep(walk, assembled, from, to, error)
        class(links_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: from, to
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: ends(:, :), numbers(:, :, :)
        logical, allocatable :: closed(:, :)

        associate (unused => assembled, n => walk%number)
            if (n == size(walk%ends, 2)) then
                allocate (ends(2, 2*n), numbers(size(walk%numbers, 1), 2, 2*n), closed(size(walk%closed, 1), 2*n))
                ends(:, :n) = walk%ends
                numbers(:, :, :n) = walk%numbers
                closed(:, :n) = walk%closed
                call move_alloc(ends, walk%ends)
                call move_alloc(numbers, walk%numbers)
                call move_alloc(closed, walk%closed)
            end if
        end associate
        walk%number = walk%number + 1
        associate (k => walk%number)
            walk%ends(:, k) = [from, to]
            walk%numbers(:, 1, k) = walk%start
            walk%numbers(:, 2, k) = numbers_of(walk)
            walk%closed(:, k) = walk%chain%closed
        end associate
        walk%start = walk%numbers(:, 2, walk%number)
    end subroutine keep

    !> Put the chain into a state at its load factor, or that the beam slides
    subroutine take_links(assembled, state, error)
        !> Whose bending feels links along the beam
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(inout) :: state
        !> As for follow_links
        type(error_type), allocatable, intent(out) :: error
        type(links_type) :: links

        call follow_links(assembled, state%factor, links, error)
        if (allocated(error)) return
        state%slides = links%lost
        if (links%lost) return
        ! Where the last stretch ends, on the laws as they were where it began
        call take_numbers(assembled, links%start, links%support, links%chain%closed, state)
        if (allocated(links%contact)) state%along_contact = links%contact
        state%loose_along = links%chain%loose
    end subroutine take_links

    !> Put numbers of the chain into a state
    pure subroutine take_numbers(assembled, numbers, support, closed, state)
        type(assembled_type), intent(in) :: assembled
        !> By numbers_of, the support of the model of every link, and their scheme
        real(wp), intent(in) :: numbers(:)
        integer, intent(in) :: support(:)
        logical, intent(in) :: closed(:)
        type(state_type), intent(inout) :: state
        integer :: n, l

        n = size(state%tension)
        state%displacement(:) = numbers(:n + 1)
        state%tension(:) = numbers(n + 2:2*n + 1)
        state%along = closed
        if (allocated(state%along_contact)) deallocate (state%along_contact)
        state%axial_reaction(:) = 0.0_wp
        if (allocated(state%along_force)) deallocate (state%along_force)
        allocate (state%along_force(size(assembled%model%supports)), source=0.0_wp)
        do l = 1, size(support)
            state%along_force(support(l)) = numbers(2*n + 1 + l)
            associate (node => assembled%axial%node(support(l)))
                state%axial_reaction(node) = state%axial_reaction(node) + numbers(2*n + 1 + l)
            end associate
        end do
    end subroutine take_numbers

    !> Forces in the bars where the links change, and by how much they grow with the load factor from there on, as
    !> tensions_of_loads
    subroutine tensions_of_links(assembled, to, begins, tension)
        !> Whose bending feels links along the beam
        type(assembled_type), intent(in) :: assembled
        !> How far
        real(wp), intent(in) :: to
        !> Load factors from 0 on, shape (m), and for every piece force and growth, shape (2, npiece, m); 0 where the chain
        !> cannot be followed
        real(wp), allocatable, intent(out) :: begins(:), tension(:, :, :)
        type(links_type) :: links
        type(error_type), allocatable :: error
        integer :: k, bar, piece, unit

        call follow_links(assembled, to, links, error)
        associate (m => max(1, links%number), n => size(assembled%pieces))
            allocate (begins(m), tension(2, n, m), source=0.0_wp)
        end associate
        if (allocated(error)) return
        unit = assembled%axial%units%force + rotation_unit(assembled%units) - assembled%units%force
        do k = 1, links%number
            associate (first => links%numbers(:, 1, k), last => links%numbers(:, 2, k), n => size(links%chain%flexibility), &
                       way => links%ends(2, k) - links%ends(1, k))
                if (k > 1) begins(k) = links%ends(1, k)
                bar = 1
                do piece = 1, size(assembled%pieces)
                    if (piece > assembled%axial%point(bar)) bar = bar + 1
                    associate (i => n + 1 + bar)
                        tension(:, piece, k) = scale([first(i), (last(i) - first(i))/way], unit)
                    end associate
                end do
            end associate
        end do
    end subroutine tensions_of_links

    !> What happens to the links along the beam between two schemes of theirs
    pure function changes_along(assembled, before, after) result(changes)
        type(assembled_type), intent(in) :: assembled
        logical, intent(in) :: before(:), after(:)
        type(link_change_type), allocatable :: changes(:)
        type(acting_type) :: acting
        integer :: k, last, change, number

        allocate (changes(size(assembled%axial%laws)))
        number = 0
        k = 1
        associate (laws => assembled%axial%laws, support => assembled%axial%support)
            do while (k <= size(laws))
                last = last_breakpoint(laws, k)
                if (any(before(k:last) .neqv. after(k:last))) then
                    associate (side => assembled%model%supports(support(k))%side)
                        acting = acting_piece(laws(k:last), side, after(k:last))
                        change = what_happens(acting_piece(laws(k:last), side, before(k:last)), acting)
                    end associate
                    if (assembled%axial%rubs(k)) change = merge(gapbeam_sticks, gapbeam_slips, after(k) .neqv. after(last))
                    if (change /= no_change) then
                        number = number + 1
                        changes(number) = link_change_type(support(k), change, acting%condition)
                    end if
                end if
                k = last + 1
            end do
        end associate
        changes = changes(:number)
    end function changes_along

end module gapbeam_axial_links

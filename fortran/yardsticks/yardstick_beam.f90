!> Common parts of the yardsticks: the beam as plain arrays, the search for the contact state.
!>
!> Not part of the engine. A yardstick is what a user would have to write without it, so this is kept as plain as that:
!> every mesh point is a node, all wrong supports are switched at once.
module yardstick_beam
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: beam_type, answer_type, method_type, find_contact_state
    public :: is_rigid, node_load, shear_reactions
    public :: solved, singular, no_scheme

    !> What became of a beam: solved; a matrix that is singular or not positive definite; no scheme found
    integer, parameter :: solved = 0, singular = 1, no_scheme = 2
    !> Solves in which all wrong supports are switched; after that one at a time, which ends most cycles
    integer, parameter :: most_block_solves = 40
    !> Solves before giving up
    integer, parameter :: most_solves = 1000

    !> A beam of n elements
    type :: beam_type
        !> Length, EI and uniform load (down) of every element, shape (n)
        real(wp), pointer, contiguous :: length(:) => null(), ei(:) => null(), q(:) => null()
        !> Side of the support of every node, shape (0:n): 1 pushes up only, -1 down only, 0 both
        integer, pointer, contiguous :: side(:) => null()
        !> Its stiffness (0 none, infinite rigid), deflection of first contact; force (down), shape (0:n)
        real(wp), pointer, contiguous :: stiff(:) => null(), level(:) => null(), force(:) => null()
        !> Is the rotation held at the first and at the last node
        logical :: clamped(2) = .false.
    end type beam_type

    !> Deflection, moment (sagging) and reaction (up) of every node, shape (0:n)
    type :: answer_type
        real(wp), pointer, contiguous :: w(:) => null(), m(:) => null(), r(:) => null()
    end type answer_type

    !> A way to solve a contact state
    type, abstract :: method_type
    contains
        !> Solve one scheme
        procedure(solve_interface), deferred :: solve
        !> Improve the solution of the scheme that was solved last
        procedure(solve_interface), deferred :: finish
    end type method_type

    abstract interface
        subroutine solve_interface(self, beam, closed, answer, status)
            import :: method_type, beam_type, answer_type
            implicit none
            class(method_type), intent(inout) :: self
            type(beam_type), intent(in) :: beam
            !> Which supports act, shape (0:n)
            logical, intent(in) :: closed(0:)
            type(answer_type), intent(in) :: answer
            integer, intent(out) :: status
        end subroutine solve_interface
    end interface

contains

    !> Switch all wrong supports until none is wrong, starting with all of them closed
    subroutine find_contact_state(method, beam, answer, closed, solves, status)
        !> How every scheme is solved
        class(method_type), intent(inout) :: method
        !> The beam and where its answer goes
        type(beam_type), intent(in) :: beam
        type(answer_type), intent(in) :: answer
        !> The contact state found, shape (0:n)
        logical, intent(out) :: closed(0:)
        !> Schemes solved
        integer, intent(out) :: solves
        !> solved, singular or no_scheme
        integer, intent(out) :: status
        logical :: wrong
        integer :: i, switched

        closed = beam%stiff > 0.0_wp
        do solves = 1, most_solves
            call method%solve(beam, closed, answer, status)
            if (status /= solved) return
            switched = 0
            do i = 0, size(beam%length)
                if (beam%side(i) == 0 .or. .not. beam%stiff(i) > 0.0_wp) cycle
                if (closed(i)) then
                    wrong = beam%side(i)*answer%r(i) < 0.0_wp
                else
                    wrong = beam%side(i)*(answer%w(i) - beam%level(i)) > 0.0_wp
                end if
                if (.not. wrong) cycle
                closed(i) = .not. closed(i)
                switched = switched + 1
                if (solves > most_block_solves) exit
            end do
            if (switched == 0) exit
        end do
        status = merge(solved, no_scheme, solves <= most_solves)
        if (status == solved) call method%finish(beam, closed, answer, status)
    end subroutine find_contact_state

    !> Is the deflection of a node known
    elemental function is_rigid(stiffness, closed) result(rigid)
        !> Of its support, and whether that acts
        real(wp), intent(in) :: stiffness
        logical, intent(in) :: closed
        logical :: rigid

        rigid = closed .and. stiffness > huge(stiffness)
    end function is_rigid

    !> Force on a node with half of the loads of the elements beside it
    pure function node_load(beam, i) result(load)
        type(beam_type), intent(in) :: beam
        !> The node, from 0
        integer, intent(in) :: i
        real(wp) :: load

        load = beam%force(i)
        if (i > 0) load = load + beam%q(i)*beam%length(i)/2
        if (i < size(beam%length)) load = load + beam%q(i + 1)*beam%length(i + 1)/2
    end function node_load

    !> Reactions: of springs from the deflections, of rigid supports from the jump of the shear that the moments make
    !>
    !> The shear of a short element, (M_b - M_a)/length, loses digits where the moments are large; the equilibrium of a node
    !> that is not held gives it from a neighbour that has lost fewer. So does the engine.
    subroutine shear_reactions(beam, closed, answer, shear, uncertain)
        type(beam_type), intent(in) :: beam
        !> Which supports act, shape (0:n)
        logical, intent(in) :: closed(0:)
        !> Deflections and moments in, reactions out
        type(answer_type), intent(in) :: answer
        !> Shears of the elements beside those of the simple bars, and their rounding errors, shape (n)
        real(wp), intent(out) :: shear(:), uncertain(:)
        real(wp) :: lost
        integer :: i, n

        n = size(beam%length)
        do i = 1, n
            shear(i) = (answer%m(i) - answer%m(i - 1))/beam%length(i)
            uncertain(i) = epsilon(lost)*(abs(answer%m(i)) + abs(answer%m(i - 1)))/beam%length(i)
        end do
        do i = 0, n
            if (is_rigid(beam%stiff(i), closed(i))) then
                answer%r(i) = node_load(beam, i)
            else if (closed(i)) then
                answer%r(i) = beam%stiff(i)*(answer%w(i) - beam%level(i))
            else
                answer%r(i) = 0.0_wp
            end if
        end do
        lost = 0.0_wp
        do i = 1, n - 1
            call pass(i, i, i + 1)
        end do
        lost = 0.0_wp
        do i = n - 1, 1, -1
            call pass(i, i + 1, i)
        end do
        do i = 1, n
            if (is_rigid(beam%stiff(i - 1), closed(i - 1))) answer%r(i - 1) = answer%r(i - 1) + shear(i)
            if (is_rigid(beam%stiff(i), closed(i))) answer%r(i) = answer%r(i) - shear(i)
        end do

    contains

        !> Hand a shear over a node where that is better; many steps are summed, so what each loses is kept (Knuth 1969)
        subroutine pass(node, from, to)
            integer, intent(in) :: node, from, to
            real(wp) :: change, error, total, part

            if (is_rigid(beam%stiff(node), closed(node))) then
                lost = 0.0_wp
                return
            end if
            change = (to - from)*(answer%r(node) - node_load(beam, node))
            error = uncertain(from) + epsilon(error)*abs(change)
            if (.not. error < uncertain(to)) then
                lost = 0.0_wp
                return
            end if
            change = change + lost
            total = shear(from) + change
            part = total - shear(from)
            lost = (shear(from) - (total - part)) + (change - part)
            shear(to) = total
            uncertain(to) = error
        end subroutine pass

    end subroutine shear_reactions

end module yardstick_beam

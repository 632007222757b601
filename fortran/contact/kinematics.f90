!> Free motions of a beam, found by counting bodies and constraints, not by numbers.
!>
!> Hinges cut the beam into bodies that move rigidly in a free motion, since bending resists. A body is described by
!> the displacements of its two ends. Each support that acts in it is one condition on them, a clamp, a
!> rotational spring or tension, which keeps its direction, one more; two conditions at different places fix the body.
!> Going from left to right this gives every independent motion of the chain.
module gapbeam_kinematics
    use gapbeam_kinds, only: wp
    use gapbeam_nodes, only: restrained, hinge_left, hinge_right, is_hinge
    use gapbeam_law_kinematics, only: mark_held, lets_go_beyond, leaves_all
    use gapbeam_model, only: beam_type, last_place
    use gapbeam_turning, only: find_kinds, turn_with
    implicit none
    private
    public :: free_motions, motion_type, work_of_loads, held_by_ties

    !> An independent free motion
    type :: motion_type
        !> First and last node that move
        integer :: first, last
        !> Downward displacement of these nodes and of those between them, largest 1, shape (first:last)
        real(wp), allocatable :: displacement(:)
    end type motion_type

    !> Motions that are found, and the one that is followed from left to right
    type :: followed_type
        !> Places of the nodes and how they move, shape (0:n), and which of them are held, shape (0:n + r)
        real(wp), allocatable :: x(:), y(:)
        logical, allocatable :: fixed(:)
        !> Sums of tension times length from the left end to the nodes: what resists a rotation of what lies between, shape (0:n)
        real(wp), allocatable :: pull(:)
        !> Kinds of the nodes in the scheme at hand, shape (0:n)
        integer, allocatable :: kind(:)
        !> Does the left end of the body at hand move, by y there; node from which on y is that of this motion
        logical :: moving = .true.
        integer :: origin = 0
        !> The first `number` entries are found
        type(motion_type), allocatable :: motions(:)
        integer :: number = 0
    end type followed_type

contains

    !> All independent free motions while the given supports act
    subroutine free_motions(beam, acting, motions)
        type(beam_type), intent(in) :: beam
        !> Which supports act, shape (size(beam%supports))
        logical, intent(in) :: acting(:)
        !> The motions; none for a sound structure
        type(motion_type), allocatable, intent(out) :: motions(:)
        type(followed_type) :: followed
        integer :: n, i, start, conditions
        logical :: clamp
        real(wp) :: pivot

        n = size(beam%links)
        call begin_at_left_end(beam, acting, followed)
        start = 0
        associate (x => followed%x, fixed => followed%fixed)
            do while (start < n)
                do i = start + 1, n - 1
                    if (is_hinge(followed%kind(i))) exit
                end do
                clamp = any(followed%kind(start:i) == restrained) .or. followed%kind(start) == hinge_right &
                    .or. followed%kind(i) == hinge_left .or. followed%pull(i) - followed%pull(start) > 0.0_wp
                conditions = count(fixed(start:i)) + merge(1, 0, clamp)
                if (conditions == 0) then
                    ! The right end is free whatever the left end does
                    if (followed%moving) call close_motion(followed, start, i)
                    call open_motion(followed, start, i)
                else if (conditions > 1) then
                    call drop_motion(followed, start)
                    followed%y(i) = 0.0_wp
                    followed%moving = .false.
                else if (clamp) then
                    call extend_motion(followed, start, i, 1.0_wp)
                else if (fixed(start)) then
                    call drop_motion(followed, start)
                    call open_motion(followed, start, i)
                else if (fixed(i)) then
                    if (followed%moving) call close_motion(followed, start, i)
                    followed%y(i) = 0.0_wp
                    followed%moving = .false.
                else
                    pivot = x(start + findloc(fixed(start:i), .true., 1) - 1)
                    call extend_motion(followed, start, i, -(x(i) - pivot)/(pivot - x(start)))
                end if
                start = i
            end do
        end associate
        if (followed%moving) call record(followed, n)
        allocate (motions(followed%number))
        do i = 1, followed%number
            motions(i) = followed%motions(i)
        end do
    end subroutine free_motions

    !> The left end of the beam moves, if nothing holds it
    subroutine begin_at_left_end(beam, acting, followed)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(followed_type), intent(out) :: followed
        integer :: i, n

        n = size(beam%links)
        allocate (followed%x(0:n), followed%y(0:n), followed%fixed(0:last_place(beam)), followed%kind(0:n), followed%motions(8))
        call find_kinds(beam, acting, followed%kind)
        followed%x(0) = 0.0_wp
        do i = 1, n
            followed%x(i) = followed%x(i - 1) + beam%links(i)%length
        end do
        followed%fixed(:) = .false.
        call mark_held(beam%supports, acting, followed%fixed)
        allocate (followed%pull(0:n), source=0.0_wp)
        if (allocated(beam%ground)) then
            do i = 1, n
                followed%pull(i) = followed%pull(i - 1)
                if (beam%ground(i)%grounded) then
                    followed%fixed(i - 1:i) = .true.
                else
                    followed%pull(i) = followed%pull(i) + beam%ground(i)%gaa*beam%links(i)%length**2
                end if
            end do
        end if
        followed%y(:) = 0.0_wp
        followed%y(0) = 1.0_wp
    end subroutine begin_at_left_end

    !> The followed motion goes on through a body
    pure subroutine extend_motion(followed, from, to, ratio)
        type(followed_type), intent(inout) :: followed
        integer, intent(in) :: from, to
        real(wp), intent(in) :: ratio

        followed%y(to) = ratio*followed%y(from)
        if (followed%moving) call fill(followed, from, to)
    end subroutine extend_motion

    !> The followed motion ends with the body turning about its right end
    pure subroutine close_motion(followed, from, to)
        type(followed_type), intent(inout) :: followed
        integer, intent(in) :: from, to

        followed%y(to) = 0.0_wp
        call fill(followed, from, to)
        call record(followed, to)
    end subroutine close_motion

    !> The left end cannot move after all
    pure subroutine drop_motion(followed, from)
        type(followed_type), intent(inout) :: followed
        integer, intent(in) :: from

        followed%y(followed%origin:from) = 0.0_wp
        followed%origin = from
    end subroutine drop_motion

    !> A new motion: the body turns about its left end
    pure subroutine open_motion(followed, from, to)
        type(followed_type), intent(inout) :: followed
        integer, intent(in) :: from, to

        call drop_motion(followed, from)
        followed%y(to) = 1.0_wp
        followed%moving = .true.
        call fill(followed, from, to)
    end subroutine open_motion

    !> Straight line between the ends of a body
    pure subroutine fill(followed, from, to)
        type(followed_type), intent(inout) :: followed
        integer, intent(in) :: from, to
        integer :: k

        associate (x => followed%x, y => followed%y)
            do k = from + 1, to - 1
                y(k) = (y(from)*(x(to) - x(k)) + y(to)*(x(k) - x(from)))/(x(to) - x(from))
                if (followed%fixed(k)) y(k) = 0.0_wp
            end do
        end associate
    end subroutine fill

    !> The motion at hand ends at a node at the latest
    pure subroutine record(followed, to)
        type(followed_type), intent(inout) :: followed
        integer, intent(in) :: to
        type(motion_type), allocatable :: longer(:)

        followed%moving = .false.
        if (followed%number == size(followed%motions)) then
            allocate (longer(2*followed%number))
            longer(1:followed%number) = followed%motions
            call move_alloc(longer, followed%motions)
        end if
        followed%number = followed%number + 1
        associate (motion => followed%motions(followed%number), origin => followed%origin, y => followed%y)
            motion%first = origin - 1 + findloc(abs(y(origin:to)) > 0.0_wp, .true., 1)
            motion%last = origin - 1 + findloc(abs(y(origin:to)) > 0.0_wp, .true., 1, back=.true.)
            allocate (motion%displacement(motion%first:motion%last), source=y(motion%first:motion%last)/maxval(abs(y(origin:to))))
        end associate
    end subroutine record

    !> Is the beam free to move but for supports that carry nothing: then its position is not unique
    function held_by_ties(beam, closed, undecided) result(free)
        !> The beam and its scheme
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Supports at zero
        logical, intent(in) :: undecided(:)
        logical :: free
        type(motion_type), allocatable :: motions(:)
        real(wp), allocatable :: moved(:)
        integer :: m, way

        free = .false.
        if (.not. any(undecided .and. (closed .neqv. lets_go_beyond(beam%supports)))) return
        call free_motions(beam, merge(lets_go_beyond(beam%supports), closed, undecided), motions)
        allocate (moved(0:last_place(beam)))
        do m = 1, size(motions)
            moved(:) = 0.0_wp
            moved(motions(m)%first:motions(m)%last) = motions(m)%displacement
            call turn_with(beam, moved)
            do way = -1, 1, 2
                free = free .or. leaves_all(beam%supports, undecided, moved, way)
            end do
        end do
    end function held_by_ties

    !> Work of the loads along a motion, and the sum of the absolute values of its parts
    pure subroutine work_of_loads(beam, factor, displacement, range, work, size_of_parts)
        !> The beam and the factor of its live loads
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> Displacements of the nodes, straight between them, shape (0:n), and the first and last node that move
        real(wp), intent(in) :: displacement(0:)
        integer, intent(in) :: range(2)
        !> Work, and how large its parts are
        real(wp), intent(out) :: work, size_of_parts
        real(wp) :: part, share(2)
        integer :: i, j, n

        n = size(beam%links)
        share = [1.0_wp, factor]
        work = 0.0_wp
        size_of_parts = 0.0_wp
        do i = max(0, range(1) - 1), min(n, range(2) + 1)
            part = displacement(i)*dot_product(share, beam%force(:, i))
            work = work + part
            size_of_parts = size_of_parts + abs(part)
            ! A couple turns with the body to the right of its node, at the right end with the one to the left
            j = min(i + 1, n)
            part = dot_product(share, beam%couple(:, i))*(displacement(j) - displacement(j - 1))/beam%links(j)%length
            work = work + part
            size_of_parts = size_of_parts + abs(part)
            if (i == n) exit
            associate (link => beam%links(i + 1))
                part = displacement(i)*dot_product(share, link%shear_a)
                work = work + part
                size_of_parts = size_of_parts + abs(part)
                part = -displacement(i + 1)*dot_product(share, link%shear_b)
                work = work + part
                size_of_parts = size_of_parts + abs(part)
                ! Loads that cancel inside the link are as uncertain as each of them
                size_of_parts = size_of_parts + (abs(displacement(i)) + abs(displacement(i + 1))) &
                    *dot_product(abs(share), link%load_sum)
            end associate
        end do
    end subroutine work_of_loads

end module gapbeam_kinematics

!> Free motions of a beam along which the loads do work, unbounded if no support stops them.
module gapbeam_unbounded_motions
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: no_work, clearly_more
    use gapbeam_band, only: hinge, restrained
    use gapbeam_law, only: below, above
    use gapbeam_law_kinematics, only: find_level_forces, outermost, is_blocked
    use gapbeam_model, only: beam_type, last_place
    use gapbeam_turning, only: turn_with
    use gapbeam_kinematics, only: free_motions, motion_type, work_of_loads
    implicit none
    private
    public :: unbounded_motion_type, find_unbounded_motions, prefer_rotation_mode

    !> A part of the beam that the loads move while a scheme acts: first and last node that move
    type :: unbounded_motion_type
        integer :: first, last
    end type unbounded_motion_type

contains

    !> The free motions into which the loads push the beam while a scheme acts: of each part that moves by itself the
    !> combination of its independent motions whose work is greatest for its size, the direction in which the weak springs give
    !> way
    subroutine find_unbounded_motions(beam, factor, closed, direction, unbounded, stable, in_doubt)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> Displacements of the nodes, largest 1 in every part, and the rotations that go with them; zero if no load does work;
        !> shape (0:n + r)
        real(wp), intent(out) :: direction(0:)
        !> The parts that the loads move
        type(unbounded_motion_type), allocatable, intent(out) :: unbounded(:)
        !> Is there no free motion at all; is work of the loads near its rounding error
        logical, intent(out) :: stable, in_doubt
        type(motion_type), allocatable :: motions(:)
        real(wp), allocatable :: y(:), level(:), gram(:, :), share(:)
        real(wp) :: parts, largest
        integer :: k, n, begin, finish, last, number

        n = size(beam%links)
        call free_motions(beam, closed, motions)
        stable = size(motions) == 0
        in_doubt = .false.
        direction = 0.0_wp
        allocate (unbounded(0))
        if (stable) return
        allocate (share(size(motions)), y(0:last_place(beam)), level(0:last_place(beam)))
        y(:) = 0.0_wp
        call find_level_forces(beam%supports, closed, level)
        do k = 1, size(motions)
            associate (motion => motions(k))
                y(motion%first:motion%last) = motion%displacement
                call work_of_loads(beam, factor, y, [motion%first, motion%last], share(k), parts)
                call turn_with(beam, y)
                ! Less what supports that yield take of it
                associate (taken => level(motion%first:motion%last)*motion%displacement, &
                           taken_by_turning => level(n + 1:)*y(n + 1:))
                    share(k) = share(k) - sum(taken) - sum(taken_by_turning)
                    parts = parts + sum(abs(taken)) + sum(abs(taken_by_turning))
                end associate
                y(motion%first:motion%last) = 0.0_wp
            end associate
            in_doubt = in_doubt .or. (abs(share(k)) > 0.0_wp .and. abs(share(k)) <= clearly_more*no_work*parts)
            if (abs(share(k)) <= no_work*parts) share(k) = 0.0_wp
        end do
        deallocate (unbounded)
        allocate (unbounded(size(motions)))
        number = 0
        begin = 1
        do while (begin <= size(motions))
            finish = begin
            last = motions(begin)%last
            do while (finish < size(motions))
                if (motions(finish + 1)%first > last) exit
                finish = finish + 1
                last = max(last, motions(finish)%last)
            end do
            call overlaps(motions(begin:finish), gram)
            call solve_gram(gram, share(begin:finish))
            do k = begin, finish
                associate (d => direction(motions(k)%first:motions(k)%last))
                    d = d + share(k)*motions(k)%displacement
                end associate
            end do
            associate (first => motions(begin)%first)
                largest = maxval(abs(direction(first:last)))
                if (largest > 0.0_wp) then
                    direction(first:last) = direction(first:last)/largest
                    number = number + 1
                    unbounded(number) = unbounded_motion_type(first, last)
                end if
            end associate
            begin = finish + 1
        end do
        unbounded = unbounded(1:number)
        call turn_with(beam, direction)
    end subroutine find_unbounded_motions

    !> Scalar products of motions and those before them that they overlap with: gram(j, k) of motions k and k - j
    pure subroutine overlaps(motions, gram)
        type(motion_type), intent(in) :: motions(:)
        real(wp), allocatable, intent(out) :: gram(:, :)
        integer :: j, k, width, from, to

        width = 0
        do k = 1, size(motions)
            do j = 1, k - 1
                if (motions(j)%last < motions(k)%first) cycle
                width = max(width, k - j)
                exit
            end do
        end do
        allocate (gram(0:width, size(motions)), source=0.0_wp)
        do k = 1, size(motions)
            do j = 0, min(width, k - 1)
                from = max(motions(k)%first, motions(k - j)%first)
                to = min(motions(k)%last, motions(k - j)%last)
                if (from <= to) gram(j, k) = dot_product(motions(k)%displacement(from:to), motions(k - j)%displacement(from:to))
            end do
        end do
    end subroutine overlaps

    !> Solve with a band of scalar products (Cholesky, without roots); the motions are independent, so it is positive definite
    pure subroutine solve_gram(gram, share)
        !> Overwritten
        real(wp), intent(inout) :: gram(0:, :)
        !> Right-hand side in, solution out
        real(wp), intent(inout) :: share(:)
        real(wp) :: multiplier
        integer :: i, j, k, width

        width = ubound(gram, 1)
        do k = 1, size(share)
            do i = k + 1, min(k + width, size(share))
                multiplier = gram(i - k, i)/gram(0, k)
                share(i) = share(i) - multiplier*share(k)
                do j = i, min(k + width, size(share))
                    gram(j - i, j) = gram(j - i, j) - multiplier*gram(j - k, j)
                end do
            end do
        end do
        do k = size(share), 1, -1
            do i = k + 1, min(k + width, size(share))
                share(k) = share(k) - gram(i - k, i)*share(i)
            end do
            share(k) = share(k)/gram(0, k)
        end do
    end subroutine solve_gram

    !> Of the ways in which a beam without hinges can go, the plainest: tipping about one of its supports, or moving as a
    !> whole; the one along which the loads do most work. The motion found is kept if none of these is free. Only the
    !> outermost supports of each side can be what the beam tips about: the next ones would be in the way
    subroutine prefer_rotation_mode(beam, factor, direction)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> Shape (0:n + r)
        real(wp), intent(inout) :: direction(0:)
        real(wp), allocatable :: x(:), y(:), best(:)
        real(wp) :: most
        integer :: i, n, side, tips(2)

        n = size(beam%links)
        ! A hinge with a law may give way, and a restraint may hold
        if (any(beam%kind == hinge) .or. allocated(beam%turning)) return
        allocate (x(0:n), y(0:n), best(0:n))
        x(0) = 0.0_wp
        do i = 1, n
            x(i) = x(i - 1) + beam%links(i)%length
        end do
        most = 0.0_wp
        best(:) = direction
        y(:) = 1.0_wp
        call consider()
        do side = above, below
            if (any(beam%kind == restrained)) exit
            tips = outermost(beam%supports, side)
            if (tips(1) > tips(2)) cycle
            do i = 1, 2
                y(:) = x - x(tips(i))
                call consider()
            end do
        end do
        direction(:) = best

    contains

        !> Take the motion y, or its opposite, if it is free and does more work than any before
        subroutine consider()
            real(wp) :: done, parts
            integer :: way

            y(:) = y/maxval(abs(y))
            do way = 1, 2
                y(:) = -y
                if (is_blocked(beam%supports, y)) cycle
                call work_of_loads(beam, factor, y, [0, n], done, parts)
                if (done <= max(most, no_work*parts)) cycle
                most = done
                best(:) = y
            end do
        end subroutine consider

    end subroutine prefer_rotation_mode

end module gapbeam_unbounded_motions

!> Laws of the ground with parameters as polylines: for springs, from which the curves themselves are then found
module gapbeam_law_points
    use gapbeam_kinds, only: wp
    use gapbeam_layers, only: law_piece_type, law_plastic, law_hardening, law_hyperbolic, law_tanh
    implicit none
    private
    public :: most_points, points_of_law

    !> Pieces of a polyline at most
    integer, parameter :: most_points = 40
    !> Curves are followed between these powers of two of their typical displacement, so that no slope is next to nothing: beyond
    !> them a tanh and a hyperbola are as good as level
    integer, parameter :: first_power = -2, last_tanh = 2, last_hyperbola = 8, first_cubic = -8, last_cubic = 16

contains

    !> Pieces of a law at a place
    pure subroutine points_of_law(law, p, points, number)
        !> The law, not by points, and its parameters
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        !> From displacement, force and slope, shape (most_points)
        type(law_piece_type), intent(out) :: points(:)
        !> How many there are; none where the ground bears nothing
        integer, intent(out) :: number

        number = 0
        select case (law)
        case (law_plastic, law_hardening)
            if (p(1) > 0.0_wp .and. p(2) > 0.0_wp) call add(points, number, 0.0_wp, 0.0_wp, p(1))
            if (p(1) > 0.0_wp .and. p(2) < p(1)*(huge(1.0_wp)/4)) then
                if (law == law_hardening) call add(points, number, p(2)/p(1), p(2), p(3))
                if (law == law_plastic .and. number > 0) call add(points, number, p(2)/p(1), p(2), 0.0_wp)
            else if (law == law_hardening .and. .not. p(2) > 0.0_wp .and. p(3) > 0.0_wp) then
                call add(points, number, 0.0_wp, 0.0_wp, p(3))
            end if
        case (law_hyperbolic, law_tanh)
            if (minval(p(1:2)) > 0.0_wp) call follow_levelling(law, p, points, number)
        case default
            call follow_cubic(p, points, number)
        end select
    end subroutine points_of_law

    !> One more piece
    pure subroutine add(points, number, displacement, force, slope)
        type(law_piece_type), intent(inout) :: points(:)
        integer, intent(inout) :: number
        real(wp), intent(in) :: displacement, force, slope

        number = number + 1
        points(number) = law_piece_type(displacement, force, slope)
    end subroutine add

    !> Tangents: from outside, as Newton's method goes on best from too small displacements
    pure subroutine follow_levelling(law, p, points, number)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        type(law_piece_type), intent(inout) :: points(:)
        integer, intent(inout) :: number
        real(wp) :: d, f, slope, meeting, share
        integer :: power, last

        call add(points, number, 0.0_wp, 0.0_wp, p(1))
        last = merge(last_tanh, last_hyperbola, law == law_tanh)
        do power = first_power, last + 1
            if (power <= last) then
                d = 2.0_wp**power*(p(2)/p(1))
                if (law == law_tanh) then
                    share = tanh(2.0_wp**power)
                    f = p(2)*share
                    slope = p(1)*(4*exp(-2*2.0_wp**power)/(1 + exp(-2*2.0_wp**power))**2)
                else
                    f = p(2)*(2.0_wp**power/(1 + 2.0_wp**power))
                    slope = p(1)/(1 + 2.0_wp**power)**2
                end if
            else
                ! Level
                d = 2.0_wp**power*(p(2)/p(1))
                f = p(2)
                slope = 0.0_wp
            end if
            associate (before => points(number))
                meeting = ((f - slope*d) - (before%force - before%slope*before%displacement))/(before%slope - slope)
                call add(points, number, meeting, before%force + before%slope*(meeting - before%displacement), slope)
            end associate
        end do
        points(number)%force = p(2)
    end subroutine follow_levelling

    !> Chords, closer where two of the parts are equal
    pure subroutine follow_cubic(p, points, number)
        real(wp), intent(in) :: p(:)
        type(law_piece_type), intent(inout) :: points(:)
        integer, intent(inout) :: number
        real(wp) :: scale, d, f, last(2)
        integer :: power

        if (.not. maxval(p) > 0.0_wp) return
        scale = 1.0_wp
        if (p(1) > 0.0_wp .and. p(3) > 0.0_wp) then
            scale = sqrt(p(1))/sqrt(p(3))
        else if (p(1) > 0.0_wp .and. p(2) > 0.0_wp) then
            scale = p(1)/p(2)
        else if (p(2) > 0.0_wp .and. p(3) > 0.0_wp) then
            scale = p(2)/p(3)
        end if
        last(:) = 0.0_wp
        do power = first_cubic, last_cubic
            d = 2.0_wp**power*scale
            f = d*(p(1) + d*(p(2) + d*p(3)))
            call add(points, number, last(1), last(2), max(0.0_wp, (f - last(2))/(d - last(1))))
            last(:) = [d, f]
        end do
    end subroutine follow_cubic

end module gapbeam_law_points

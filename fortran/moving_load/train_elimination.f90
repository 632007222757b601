!> The state of a beam under a train as polynomials in the position, all from one elimination.
!>
!> On a stretch of its way (gapbeam_train_path) what a train does to the links is a polynomial in the position, and so is all that
!> follows, for the system is linear: the coefficients are right-hand sides of one system, which are eliminated together by the
!> recursion of gapbeam_band. They are not refined: they tell where extreme values may be (gapbeam_train_bounds), not what these
!> are.
module gapbeam_train_elimination
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: pivot_type, plain, hinge, restrained, full, w_known, m_known, both_known, end_of_beam
    use gapbeam_model, only: beam_type
    use gapbeam_train, only: track_type
    use gapbeam_train_intervals, only: interval_type
    use gapbeam_train_columns, only: columns_type, most_columns, load_columns
    implicit none
    private
    public :: solve_columns

contains

    !> Solve for the polynomials on a stretch
    subroutine solve_columns(track, interval, from, to, columns)
        type(track_type), intent(in) :: track
        !> Where the train is, by enter_interval
        type(interval_type), intent(in) :: interval
        !> Its positions at both ends of the stretch
        real(wp), intent(in) :: from, to
        !> With a usable scheme
        type(columns_type), intent(inout) :: columns

        columns%length = (to - from)*columns%to_length
        call load_columns(track, interval, from, columns)
        call eliminate(track%beam, columns)
        call substitute(track%beam, columns)
    end subroutine solve_columns

    !> Forward, as in gapbeam_band
    pure subroutine eliminate(beam, columns)
        type(beam_type), intent(in) :: beam
        type(columns_type), intent(inout) :: columns
        real(wp), dimension(most_columns) :: e, p, m, left, right, g, m_star, w_star
        real(wp) :: h, divisor
        integer :: i, n

        n = size(beam%links)
        e(:) = 0.0_wp
        p(:) = 0.0_wp
        m(:) = 0.0_wp
        do i = 0, n
            associate (node => columns%work%nodes(i), v => columns%pivots(i), base => columns%work%rhs(i))
                if (is_plainly_held(v, node%kind)) then
                    if (i > 0) e(:) = e + columns%turn_b(:, i)
                    e(1) = e(1) + (base%left - v%phi*base%couple)
                    right(:) = e + columns%turn_a(:, i + 1)
                    right(1) = right(1) + base%right
                    columns%right(:, i) = right
                    m_star(:) = -right*v%reciprocal
                    m_star(1) = m_star(1) + v%b*base%deflection*v%reciprocal
                    h = beam%links(i + 1)%inverse
                    e(:) = beam%links(i + 1)%fab*m_star
                    e(1) = e(1) + h*base%deflection
                    p(:) = h*m_star
                    cycle
                end if
                left(:) = 0.0_wp
                right(:) = 0.0_wp
                g(:) = p
                if (i > 0) then
                    left(:) = columns%turn_b(:, i)
                    g(:) = g - columns%shear_b(:, i)
                end if
                if (i < n) then
                    right(:) = columns%turn_a(:, i + 1)
                    g(:) = g + columns%shear_a(:, i + 1)
                end if
                left(1) = left(1) + base%left
                right(1) = right(1) + base%right
                g(1) = g(1) + base%shear
                if (v%floating) then
                    columns%moment_left(:, i) = m
                    m(1) = m(1) + base%couple
                    if (node%kind == restrained) right(:) = right - node%compliance*m
                else
                    e(:) = e + left
                    left(:) = e
                    select case (node%kind)
                    case (restrained)
                        divisor = 1/(v%phi + node%compliance)
                        g(:) = g + v%beta*e*divisor
                        g(1) = g(1) + v%beta*node%compliance*base%couple*divisor
                        e(1) = e(1) - v%phi*base%couple
                        e(:) = node%compliance*e*divisor
                    case (hinge)
                        m(:) = 0.0_wp
                    case default
                        e(1) = e(1) - v%phi*base%couple
                        g(1) = g(1) + v%beta*base%couple
                    end select
                    right(:) = right + e
                end if
                columns%left(:, i) = left
                columns%right(:, i) = right
                columns%shear(:, i) = g
                if (i == n) exit
                h = beam%links(i + 1)%inverse
                associate (link => beam%links(i + 1))
                    select case (v%kind)
                    case (full)
                        m_star(:) = (v%b*g - v%c*right)*v%reciprocal
                        w_star(:) = (v%b*right + v%a*g)*v%reciprocal
                        e(:) = h*w_star + link%fab*m_star
                        p(:) = h*m_star
                    case (w_known)
                        m_star(:) = -right*v%reciprocal
                        m_star(1) = m_star(1) + v%b*base%deflection*v%reciprocal
                        e(:) = link%fab*m_star
                        e(1) = e(1) + h*base%deflection
                        p(:) = h*m_star
                    case (m_known)
                        columns%moment_right(:, i) = m
                        e(:) = link%fab*m + h*(g - h*m)*v%reciprocal
                        p(:) = h*m
                    case (both_known)
                        columns%moment_right(:, i) = m
                        e(:) = link%fab*m
                        e(1) = e(1) + h*base%deflection
                        p(:) = h*m
                    case default
                        columns%moment_right(:, i) = m
                        m(:) = m - g*link%length
                        p(:) = g
                    end select
                end associate
            end associate
        end do
    end subroutine eliminate

    !> Backward
    pure subroutine substitute(beam, columns)
        type(beam_type), intent(in) :: beam
        type(columns_type), intent(inout) :: columns
        real(wp), dimension(most_columns) :: m, w, m_next, w_next, psi_right, sums
        real(wp) :: h
        integer :: i, n

        n = size(beam%links)
        m_next(:) = 0.0_wp
        w_next(:) = 0.0_wp
        psi_right(:) = 0.0_wp
        sums(:) = 0.0_wp
        do i = n, 0, -1
            associate (node => columns%work%nodes(i), v => columns%pivots(i), base => columns%work%rhs(i), &
                       left => columns%left(:, i), right => columns%right(:, i), shear => columns%shear(:, i))
                if (is_plainly_held(v, node%kind)) then
                    associate (link => beam%links(i + 1))
                        h = link%inverse
                        w(:) = 0.0_wp
                        w(1) = base%deflection
                        m(:) = -(right + link%fab*m_next + h*w_next)*v%reciprocal
                        m(1) = m(1) + v%b*base%deflection*v%reciprocal
                        if (is_wanted(i - 1)) psi_right(:) = h*(w_next - w) + link%faa*m + link%fab*m_next
                    end associate
                    m_next(:) = m
                    m_next(1) = m_next(1) - base%couple
                    columns%moment_left(:, i) = m_next
                    columns%deflection(:, i) = w
                    columns%moment_right(:, i) = m
                    w_next(:) = w
                    sums(:) = sums + (w + m_next)
                    cycle
                end if
                if (v%kind == end_of_beam) then
                    m(:) = 0.0_wp
                    w(:) = 0.0_wp
                    if (node%held) then
                        w(1) = base%deflection
                    else
                        w(:) = shear*v%reciprocal
                    end if
                else
                    associate (link => beam%links(i + 1))
                        h = link%inverse
                        select case (v%kind)
                        case (full)
                            m(:) = (v%b*shear - v%c*right + (v%b*h - v%c*link%fab)*m_next - v%c*h*w_next)*v%reciprocal
                            w(:) = (v%b*right + v%a*shear + (v%b*link%fab + v%a*h)*m_next + v%b*h*w_next)*v%reciprocal
                        case (w_known)
                            w(:) = 0.0_wp
                            w(1) = base%deflection
                            m(:) = (v%b*w - right - link%fab*m_next - h*w_next)*v%reciprocal
                        case (m_known)
                            m(:) = columns%moment_right(:, i)
                            w(:) = (shear + h*(m_next - m))*v%reciprocal
                        case (both_known)
                            m(:) = columns%moment_right(:, i)
                            w(:) = 0.0_wp
                            w(1) = base%deflection
                        case default
                            m(:) = columns%moment_right(:, i)
                            w(:) = w_next - link%length*(link%fab*m + link%fbb*m_next + psi_right)
                        end select
                        psi_right(:) = h*(w_next - w) + link%faa*m + link%fab*m_next
                    end associate
                end if
                if (.not. v%floating) then
                    select case (node%kind)
                    case (restrained)
                        m_next(:) = (v%beta*w - left + node%compliance*m)/(v%phi + node%compliance)
                        m_next(1) = m_next(1) - node%compliance*base%couple/(v%phi + node%compliance)
                    case (hinge)
                        m_next(:) = 0.0_wp
                    case default
                        m_next(:) = m
                        m_next(1) = m_next(1) - base%couple
                    end select
                    columns%moment_left(:, i) = m_next
                else
                    m_next(:) = columns%moment_left(:, i)
                    if (node%kind == restrained) then
                        psi_right(:) = node%compliance*(m_next - m) + left
                        psi_right(1) = psi_right(1) + node%compliance*base%couple
                    else
                        psi_right(:) = psi_right + right + left
                    end if
                end if
                columns%deflection(:, i) = w
                columns%moment_right(:, i) = m
                w_next(:) = w
                sums(:) = sums + (w + m_next)
            end associate
        end do
        ! No number in a sum is an infinite one, or none
        columns%finite = all(abs(sums) <= huge(1.0_wp))

    contains

        !> Does the node to the left ask for the rotation here
        pure function is_wanted(k) result(yes)
            integer, intent(in) :: k
            logical :: yes

            yes = k >= 0
            if (yes) yes = .not. is_plainly_held(columns%pivots(k), columns%work%nodes(k)%kind)
        end function is_wanted

    end subroutine substitute

    !> Is a node held, with no hinge or restraint: its equilibrium is for its support
    pure function is_plainly_held(pivot, kind) result(so)
        type(pivot_type), intent(in) :: pivot
        integer, intent(in) :: kind
        logical :: so

        so = pivot%kind == w_known .and. kind == plain .and. .not. pivot%floating
    end function is_plainly_held

end module gapbeam_train_elimination

!> The state of a beam under a train as polynomials in the position, all from one elimination.
!>
!> On a stretch of its way (gapbeam_train_path) what a train does to the links is a polynomial in the position, and so is all that
!> follows, for the system is linear: the coefficients are right-hand sides of one system, which are eliminated together by the
!> recursion of gapbeam_band. They are not refined: they tell where extreme values may be (gapbeam_train_bounds), not what these
!> are.
module gapbeam_train_columns
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: pivot_type, factor_chain, band_ok, plain, hinge, restrained, full, w_known, m_known, &
        both_known, end_of_beam
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads, apply_scheme
    use gapbeam_train, only: train_type, track_type, reach_type
    implicit none
    private
    public :: columns_type, most_columns, new_columns, set_scheme, solve_columns, at_distance, value_of_column

    !> Coefficients at most, rounded up for the processor
    integer, parameter :: most_columns = 6

    !> Polynomials in the way of the train from the beginning of a stretch, in the engine's units
    type :: columns_type
        !> Can the system of the scheme be solved so
        logical :: usable = .false.
        !> Are all numbers of the solution numbers
        logical :: finite = .false.
        !> Factors that make the engine's units of the user's lengths and forces
        real(wp) :: to_length = 1.0_wp, to_force = 1.0_wp
        !> Length of the stretch
        real(wp) :: length = 0.0_wp
        !> What the train does to the links, shape (most_columns, n), and to which it does something
        real(wp), allocatable :: turn_a(:, :), turn_b(:, :), shear_a(:, :), shear_b(:, :)
        logical, allocatable, private :: loaded(:)
        !> The solution at the nodes, shape (most_columns, 0:n)
        real(wp), allocatable :: deflection(:, :), moment_left(:, :), moment_right(:, :)
        !> Nodes and loads that stay, as the scheme has them; the factor; right-hand sides on the way
        type(workspace_type) :: work
        type(pivot_type), allocatable, private :: pivots(:)
        real(wp), allocatable, private :: left(:, :), right(:, :), shear(:, :)
    end type columns_type

contains

    !> Room for the columns of a beam
    subroutine new_columns(track, columns, stat)
        type(track_type), intent(in) :: track
        type(columns_type), intent(out) :: columns
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat
        integer :: n

        n = size(track%beam%links)
        allocate (columns%turn_a(most_columns, n), columns%turn_b(most_columns, n), columns%shear_a(most_columns, n), &
                  columns%shear_b(most_columns, n), columns%loaded(n), columns%deflection(most_columns, 0:n), &
                  columns%moment_left(most_columns, 0:n), columns%moment_right(most_columns, 0:n), columns%pivots(0:n), &
                  columns%left(most_columns, 0:n), columns%right(most_columns, 0:n), columns%shear(most_columns, 0:n), stat=stat)
        if (stat /= 0) return
        columns%loaded(:) = .true.
        call new_workspace(track%beam, columns%work)
        columns%to_length = scale(1.0_wp, -track%length_unit)
        columns%to_force = scale(1.0_wp, -track%force_unit)
    end subroutine new_columns

    !> Factor the system of a scheme
    subroutine set_scheme(beam, closed, columns)
        !> The beam; the train's loads on it are left out
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(columns_type), intent(inout) :: columns
        integer :: state, place

        associate (work => columns%work)
            call set_loads(beam, 0.0_wp, work)
            call apply_scheme(beam, closed, [0, size(beam%links)], work)
            columns%usable = .not. any(work%nodes%stiffness < 0.0_wp)
            if (.not. columns%usable) return
            call factor_chain(work%nodes, beam%links, columns%pivots, state, place)
            columns%usable = state == band_ok
        end associate
    end subroutine set_scheme

    !> Solve for the polynomials on a stretch
    subroutine solve_columns(track, train, reach, from, to, columns)
        type(track_type), intent(in) :: track
        type(train_type), intent(in) :: train
        !> Where the train is, by enter_reach
        type(reach_type), intent(in) :: reach
        !> Its positions at both ends of the stretch
        real(wp), intent(in) :: from, to
        !> With a usable scheme
        type(columns_type), intent(inout) :: columns

        columns%length = (to - from)*columns%to_length
        call load_columns(track, train, reach, from, columns)
        call eliminate(track%beam, columns)
        call substitute(track%beam, columns)
    end subroutine solve_columns

    !> Distance of a place from the left end of a piece, in it, in the engine's units
    pure function at_distance(track, columns, piece, x) result(t)
        type(track_type), intent(in) :: track
        type(columns_type), intent(in) :: columns
        integer, intent(in) :: piece
        real(wp), intent(in) :: x
        real(wp) :: t

        t = min(max((x - track%x(piece - 1))*columns%to_length, 0.0_wp), track%length(piece))
    end function at_distance

    !> Value of a polynomial
    pure function value_of_column(c, t) result(value)
        real(wp), intent(in) :: c(most_columns)
        real(wp), intent(in) :: t
        real(wp) :: value

        value = c(1) + t*(c(2) + t*(c(3) + t*(c(4) + t*c(5))))
    end function value_of_column

    !> What the train does to the links
    subroutine load_columns(track, train, reach, from, columns)
        type(track_type), intent(in) :: track
        type(train_type), intent(in) :: train
        type(reach_type), intent(in) :: reach
        real(wp), intent(in) :: from
        type(columns_type), intent(inout) :: columns
        real(wp) :: t, f, distance
        integer :: i, j, l

        do l = 1, size(columns%loaded)
            if (.not. columns%loaded(l)) cycle
            columns%turn_a(:, l) = 0.0_wp
            columns%turn_b(:, l) = 0.0_wp
            columns%shear_a(:, l) = 0.0_wp
            columns%shear_b(:, l) = 0.0_wp
            columns%loaded(l) = .false.
        end do
        do i = 1, size(train%offset)
            j = reach%piece(i)
            if (j == 0) cycle
            l = track%link(j)
            columns%loaded(l) = .true.
            f = train%force(i)*columns%to_force
            t = at_distance(track, columns, j, from + train%offset(i))
            distance = track%before(j) + t
            associate (link => track%beam%links(l))
                call add_cubic(track%turn_a(:, j), columns%turn_a(:, l))
                call add_cubic(track%turn_b(:, j), columns%turn_b(:, l))
                columns%shear_a(1:2, l) = columns%shear_a(1:2, l) + f*link%inverse*[link%length - distance, -1.0_wp]
                columns%shear_b(1:2, l) = columns%shear_b(1:2, l) - f*link%inverse*[distance, 1.0_wp]
            end associate
        end do
        do i = 1, size(train%uniform)
            associate (load => train%uniform(i), first => reach%first(i), last => reach%last(i))
                f = load%q*columns%to_force/columns%to_length
                do j = first, last
                    l = track%link(j)
                    columns%loaded(l) = .true.
                    call add_uniform(1.0_wp, min(from + load%to, track%x(j)), &
                                     j == last .and. reach%about + load%to < track%x(j))
                    call add_uniform(-1.0_wp, max(from + load%from, track%x(j - 1)), &
                                     j == first .and. reach%about + load%from > track%x(j - 1))
                end do
            end associate
        end do

    contains

        !> Add what a force does, from what a unit force does at a distance in the piece
        pure subroutine add_cubic(c, sums)
            real(wp), intent(in) :: c(0:3)
            real(wp), intent(inout) :: sums(most_columns)

            sums(1) = sums(1) + f*(c(0) + t*(c(1) + t*(c(2) + t*c(3))))
            sums(2) = sums(2) + f*(c(1) + t*(2*c(2) + t*3*c(3)))
            sums(3) = sums(3) + f*(c(2) + t*3*c(3))
            sums(4) = sums(4) + f*c(3)
        end subroutine add_cubic

        !> Add or take away a uniform load from the left end of a piece to a place
        subroutine add_uniform(way, x, moves)
            real(wp), intent(in) :: way, x
            logical, intent(in) :: moves
            real(wp) :: y(most_columns)

            t = at_distance(track, columns, j, x)
            distance = track%before(j) + t
            associate (link => track%beam%links(l), before => track%before(j))
                y(:) = whole(track%turn_a(:, j))
                if (.not. moves) y(2:) = 0.0_wp
                columns%turn_a(:, l) = columns%turn_a(:, l) + way*f*y
                y(:) = whole(track%turn_b(:, j))
                if (.not. moves) y(2:) = 0.0_wp
                columns%turn_b(:, l) = columns%turn_b(:, l) + way*f*y
                y(:) = 0.0_wp
                y(1:3) = link%inverse*[t*(link%length - before - t/2), link%length - distance, -0.5_wp]
                if (.not. moves) y(2:) = 0.0_wp
                columns%shear_a(:, l) = columns%shear_a(:, l) + way*f*y
                y(1:3) = link%inverse*[t*(before + t/2), distance, 0.5_wp]
                if (.not. moves) y(2:) = 0.0_wp
                columns%shear_b(:, l) = columns%shear_b(:, l) - way*f*y
            end associate
        end subroutine add_uniform

        !> Integral of a cubic up to a place, as a polynomial in the way of the place
        pure function whole(c) result(y)
            real(wp), intent(in) :: c(0:3)
            real(wp) :: y(most_columns)

            y(:) = 0.0_wp
            y(1) = t*(c(0) + t*(c(1)/2 + t*(c(2)/3 + t*c(3)/4)))
            y(2) = c(0) + t*(c(1) + t*(c(2) + t*c(3)))
            y(3) = (c(1) + t*(2*c(2) + t*3*c(3)))/2
            y(4) = (c(2) + t*3*c(3))/3
            y(5) = c(3)/4
        end function whole

    end subroutine load_columns

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

end module gapbeam_train_columns

!> State of a beam under a train on a stretch of its way, as polynomials in the position.
!> What the train does to the links, and the factor of the system of a scheme (gapbeam_train_elimination solves it).
module gapbeam_train_columns
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: pivot_type, factor_chain, band_ok
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads, apply_scheme
    use gapbeam_train, only: track_type
    use gapbeam_train_intervals, only: interval_type
    implicit none
    private
    public :: columns_type, most_columns, new_columns, set_scheme, load_columns, at_distance, value_of_column

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
        type(pivot_type), allocatable :: pivots(:)
        real(wp), allocatable :: left(:, :), right(:, :), shear(:, :)
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
        real(wp), intent(in) :: c(most_columns), t
        real(wp) :: value

        value = c(1) + t*(c(2) + t*(c(3) + t*(c(4) + t*c(5))))
    end function value_of_column

    !> What the train does to the links
    subroutine load_columns(track, interval, from, columns)
        type(track_type), intent(in) :: track
        type(interval_type), intent(in) :: interval
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
        do i = 1, size(track%train%offset)
            j = interval%piece(i)
            if (j == 0) cycle
            l = track%link(j)
            columns%loaded(l) = .true.
            f = track%train%force(i)*columns%to_force
            t = at_distance(track, columns, j, from + track%train%offset(i))
            distance = track%before(j) + t
            associate (link => track%beam%links(l))
                call add_cubic(track%turn_a(:, j), columns%turn_a(:, l))
                call add_cubic(track%turn_b(:, j), columns%turn_b(:, l))
                columns%shear_a(1:2, l) = columns%shear_a(1:2, l) + f*link%inverse*[link%length - distance, -1.0_wp]
                columns%shear_b(1:2, l) = columns%shear_b(1:2, l) - f*link%inverse*[distance, 1.0_wp]
            end associate
        end do
        do i = 1, size(track%train%uniform)
            associate (load => track%train%uniform(i), first => interval%first(i), last => interval%last(i))
                f = load%q*columns%to_force/columns%to_length
                do j = first, last
                    l = track%link(j)
                    columns%loaded(l) = .true.
                    call add_uniform(1.0_wp, min(from + load%to, track%x(j)), j == last .and. interval%about + load%to < track%x(j))
                    call add_uniform(-1.0_wp, max(from + load%from, track%x(j - 1)), &
                                     j == first .and. interval%about + load%from > track%x(j - 1))
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

end module gapbeam_train_columns

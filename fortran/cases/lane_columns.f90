!> Transposition of cases into the lanes and out of them.
!> Arrays with a column for each case are turned, eight columns at a time, which compilers do in registers.
module gapbeam_lane_columns
    use gapbeam_kinds, only: wp
    use gapbeam_case_types, only: case_solutions_type
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type
    implicit none
    private
    public :: take_columns, take_numbers, give_pack

contains

    !> The supports of eight cases, as replace_supports of gapbeam_cases makes them
    pure subroutine take_numbers(beam, units, values, numbers, turned, pack, lost)
        type(lane_beam_type), intent(in) :: beam
        !> By units_of_supports
        real(wp), intent(in) :: units(3)
        !> Settlement, gap and stiffness of every support of the scene, shape (3, nsupport, ncase); which case is for which lane
        real(wp), intent(in), contiguous :: values(:, :, :)
        integer, intent(in) :: numbers(lanes)
        !> Room for them, shape (lanes, 3 nsupport)
        real(wp), intent(inout), contiguous :: turned(:, :)
        !> Its supports are replaced
        type(pack_type), intent(inout) :: pack
        !> Has a number left the range of doubles, or may a support be next to nothing
        logical, intent(out) :: lost
        integer :: k

        call take_columns(3*size(values, 2), size(values, 3), values, numbers, turned)
        lost = .false.
        do k = 1, size(beam%place)
            associate (i => beam%place(k), s => beam%number(k))
                call take_support(beam%side(i), units, turned(:, 3*s - 2:3*s), pack%stiffness(:, i), pack%rigid(:, i), &
                                  pack%contact(:, i), lost)
            end associate
        end do
    end subroutine take_numbers

    !> One support
    pure subroutine take_support(side, units, given, stiffness, rigid, contact, lost)
        real(wp), intent(in) :: side, units(3), given(lanes, 3)
        real(wp), intent(out), dimension(lanes) :: stiffness, rigid, contact
        logical, intent(inout) :: lost
        real(wp) :: scaled, wrong, is_rigid, all_wrong
        integer :: l

        all_wrong = 0.0_wp
        !$omp simd private(scaled, wrong, is_rigid) reduction(+:all_wrong)
        do l = 1, lanes
            contact(l) = (given(l, 1) + side*given(l, 2))*units(1)
            scaled = given(l, 3)*units(2)
            is_rigid = merge(1.0_wp, 0.0_wp, given(l, 3) > huge(1.0_wp))
            rigid(l) = is_rigid
            stiffness(l) = merge(0.0_wp, scaled, is_rigid > 0.5_wp)
            wrong = merge(0.0_wp, 1.0_wp, scaled >= units(3))
            wrong = merge(wrong, 1.0_wp, scaled <= huge(1.0_wp))
            wrong = merge(wrong, 0.0_wp, given(l, 3) > 0.0_wp)*(1.0_wp - is_rigid)
            wrong = merge(wrong, 1.0_wp, abs(contact(l)) <= huge(1.0_wp))
            all_wrong = all_wrong + wrong
        end do
        lost = lost .or. all_wrong > 0.5_wp
    end subroutine take_support

    !> The solutions of eight different cases in the scene's units, which hold them
    pure subroutine give_pack(beam, units, pack, numbers, turned, solutions)
        type(lane_beam_type), intent(in) :: beam
        !> What deflections, moments and forces are multiplied by
        real(wp), intent(in) :: units(3)
        type(pack_type), intent(in) :: pack
        !> Which case is in which lane
        integer, intent(in) :: numbers(lanes)
        !> Room, shape (lanes, at least size(beam%place))
        real(wp), intent(inout), contiguous :: turned(:, :)
        type(case_solutions_type), intent(inout) :: solutions
        integer :: k, m

        m = size(beam%place)
        call give_columns(beam%n + 1, pack%w, units(1), solutions%w, numbers)
        call give_columns(beam%n + 1, pack%ml, units(2), solutions%ml, numbers)
        call give_columns(beam%n + 1, pack%mr, units(2), solutions%mr, numbers)
        if (associated(solutions%reaction)) then
            do k = 1, m
                turned(:, k) = pack%reaction(:, beam%place(k))
            end do
            call give_columns(m, turned, units(3), solutions%reaction, numbers)
        end if
        do k = 1, m
            turned(:, k) = pack%closed(:, beam%place(k))
        end do
        associate (closed => solutions%closed)
            call give_whole_eight(m, turned, closed(:, numbers(1)), closed(:, numbers(2)), closed(:, numbers(3)), &
                                  closed(:, numbers(4)), closed(:, numbers(5)), closed(:, numbers(6)), closed(:, numbers(7)), &
                                  closed(:, numbers(8)))
        end associate
    end subroutine give_pack

    !> Columns of eight cases into the lanes
    pure subroutine take_columns(rows, cases, columns, numbers, to)
        integer, intent(in) :: rows, cases
        real(wp), intent(in) :: columns(rows, cases)
        !> Which case is for which lane
        integer, intent(in) :: numbers(lanes)
        real(wp), intent(out) :: to(lanes, rows)

        call take_eight(rows, columns(1, numbers(1)), columns(1, numbers(2)), columns(1, numbers(3)), columns(1, numbers(4)), &
                        columns(1, numbers(5)), columns(1, numbers(6)), columns(1, numbers(7)), columns(1, numbers(8)), to)
    end subroutine take_columns

    !> Lanes into the columns of eight different cases, where these are wanted
    pure subroutine give_columns(rows, from, unit, columns, numbers)
        !> How many rows are given, and what they are multiplied by
        integer, intent(in) :: rows
        real(wp), intent(in) :: from(lanes, rows), unit
        !> They may have more rows
        real(wp), intent(inout), pointer, contiguous :: columns(:, :)
        !> As for take_columns; no number twice
        integer, intent(in) :: numbers(lanes)

        if (.not. associated(columns)) return
        call give_eight(rows, from, unit, columns(:, numbers(1)), columns(:, numbers(2)), columns(:, numbers(3)), &
                        columns(:, numbers(4)), columns(:, numbers(5)), columns(:, numbers(6)), columns(:, numbers(7)), &
                        columns(:, numbers(8)))
    end subroutine give_columns

    !> One argument a column, as compilers turn only what does not overlap
    pure subroutine take_eight(rows, a, b, c, d, e, f, g, h, to)
        integer, intent(in) :: rows
        real(wp), intent(in), dimension(rows) :: a, b, c, d, e, f, g, h
        real(wp), intent(out) :: to(lanes, rows)
        integer :: i

        do i = 1, rows
            to(1, i) = a(i)
            to(2, i) = b(i)
            to(3, i) = c(i)
            to(4, i) = d(i)
            to(5, i) = e(i)
            to(6, i) = f(i)
            to(7, i) = g(i)
            to(8, i) = h(i)
        end do
    end subroutine take_eight

    !> Likewise back
    pure subroutine give_eight(rows, from, unit, a, b, c, d, e, f, g, h)
        integer, intent(in) :: rows
        real(wp), intent(in) :: from(lanes, rows), unit
        real(wp), intent(inout), dimension(rows) :: a, b, c, d, e, f, g, h
        integer :: i

        do i = 1, rows
            a(i) = from(1, i)*unit
            b(i) = from(2, i)*unit
            c(i) = from(3, i)*unit
            d(i) = from(4, i)*unit
            e(i) = from(5, i)*unit
            f(i) = from(6, i)*unit
            g(i) = from(7, i)*unit
            h(i) = from(8, i)*unit
        end do
    end subroutine give_eight

    !> Likewise whole numbers
    pure subroutine give_whole_eight(rows, from, a, b, c, d, e, f, g, h)
        integer, intent(in) :: rows
        real(wp), intent(in) :: from(lanes, rows)
        integer, intent(inout), dimension(rows) :: a, b, c, d, e, f, g, h
        integer :: i

        do i = 1, rows
            a(i) = int(from(1, i))
            b(i) = int(from(2, i))
            c(i) = int(from(3, i))
            d(i) = int(from(4, i))
            e(i) = int(from(5, i))
            f(i) = int(from(6, i))
            g(i) = int(from(7, i))
            h(i) = int(from(8, i))
        end do
    end subroutine give_whole_eight

end module gapbeam_lane_columns

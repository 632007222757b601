!> Checks of foundations, each alone: their moduli, gaps, tables and laws.
module gapbeam_check_foundations
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_words, only: shown, whole, pair
    use gapbeam_scene, only: model_type, foundation_type, ground_point_type, ground_law_point_type, gapbeam_both, gapbeam_below, &
        gapbeam_above, gapbeam_unchanged, gapbeam_law_by_points, gapbeam_law_cubic, gapbeam_table_of_k, gapbeam_table_of_gap, &
        gapbeam_table_of_parameter
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_input_error, only: refuse, of_foundations, not_expected, bad_law
    use gapbeam_laws, only: parameters_of_law, parameters_of, key_of_parameter
    use gapbeam_check_ground_laws, only: check_law_kind, check_parameter, check_parameters, may_be_negative
    use gapbeam_check, only: entry_type, check_stretch, refuse_entry, refuse_number
    implicit none
    private
    public :: check_foundations, find_runs, find_tables, points_of_law, at_right, is_rigid, moduli_of, quantities

    !> Of which a foundation may have tables: modulus, gap, parameters of its law
    integer, parameter :: quantities = gapbeam_table_of_parameter - 1 + parameters_of_law

contains

    !> All foundations, but what laws with tables are between their points
    pure subroutine check_foundations(model, end, error)
        !> With all arrays allocated
        type(model_type), intent(in) :: model
        !> The beam's right end
        real(wp), intent(in) :: end
        !> Bad input, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: first(quantities, size(model%foundations)), last(quantities, size(model%foundations))
        integer :: law_first(size(model%foundations)), law_last(size(model%foundations)), i, n

        n = size(model%foundations)
        call check_runs(model%ground%foundation, model%ground%quantity, n, "profile", error)
        if (.not. allocated(error)) call check_runs(model%ground_law%foundation, spread(1, 1, size(model%ground_law)), n, "law", &
                                                    error)
        if (allocated(error)) return
        call find_tables(model%ground, first, last)
        call find_runs(model%ground_law%foundation, law_first, law_last)
        do i = 1, n
            call check_foundation(model%foundations(i), model%ground, first(:, i), last(:, i), &
                                  model%ground_law(law_first(i):law_last(i)), entry_type(of_foundations, i, n), end, error)
            if (allocated(error)) return
        end do
    end subroutine check_foundations

    !> First and last point of every table
    pure subroutine find_tables(points, first, last)
        !> Of all foundations
        type(ground_point_type), intent(in) :: points(:)
        !> As for find_runs, shape (quantities, number of foundations)
        integer, intent(out) :: first(:, :), last(:, :)
        integer :: of(quantities*size(first, 2), 2)

        call find_runs(quantities*(points%foundation - 1) + points%quantity, of(:, 1), of(:, 2))
        first(:, :) = reshape(of(:, 1), shape(first))
        last(:, :) = reshape(of(:, 2), shape(last))
    end subroutine find_tables

    !> First and last entry of each owner in a list in which those of one stand beside each other
    pure subroutine find_runs(owner, first, last)
        !> Numbers from 1
        integer, intent(in) :: owner(:)
        !> The last is before the first if there is none, shape (number of owners)
        integer, intent(out) :: first(:), last(:)
        integer :: i

        first(:) = 1
        last(:) = 0
        do i = 1, size(owner)
            associate (k => owner(i))
                if (last(k) == 0) first(k) = i
                last(k) = i
            end associate
        end do
    end subroutine find_runs

    !> A number at the right end of a foundation, where none is given that at the left
    elemental function at_right(value, right) result(number)
        real(wp), intent(in) :: value, right
        real(wp) :: number

        number = right
        if (right >= gapbeam_unchanged .and. right <= gapbeam_unchanged) number = value
    end function at_right

    !> Does a foundation never give way
    elemental function is_rigid(foundation) result(rigid)
        type(foundation_type), intent(in) :: foundation
        logical :: rigid

        rigid = foundation%k > huge(foundation%k)
    end function is_rigid

    !> Moduli at its ends, of one that is rigid 0
    pure function moduli_of(foundation) result(k)
        type(foundation_type), intent(in) :: foundation
        real(wp) :: k(2)

        k = 0.0_wp
        if (.not. is_rigid(foundation)) k = [foundation%k, at_right(foundation%k, foundation%k_to)]
    end function moduli_of

    !> Do points belong to foundations that exist, and stand those of one table or law beside each other
    pure subroutine check_runs(owner, quantity, count, key, error)
        !> Foundation and quantity of every point
        integer, intent(in) :: owner(:), quantity(:)
        !> Number of foundations, and whether it is profile or law
        integer, intent(in) :: count
        character(len=*), intent(in) :: key
        type(error_type), allocatable, intent(out) :: error
        logical :: seen(quantities, count)
        integer :: i, before(2)

        seen(:, :) = .false.
        before(:) = 0
        do i = 1, size(owner)
            associate (f => owner(i), q => quantity(i))
                if (f < 1 .or. f > count) then
                    call refuse(error, of_foundations, 1, count, bad_law, key, &
                                "a point belongs to a foundation that does not exist")
                else if (q < 1 .or. q > quantities) then
                    call refuse(error, of_foundations, f, count, bad_law, "", "there is no table of a quantity "//trim(whole(q))// &
                                "; give 1 to "//trim(whole(quantities)))
                else if (any([f, q] /= before)) then
                    if (seen(q, f)) then
                        call refuse(error, of_foundations, f, count, bad_law, key, "its points must stand beside each other")
                    end if
                    seen(q, f) = .true.
                    before(:) = [f, q]
                end if
            end associate
            if (allocated(error)) return
        end do
    end subroutine check_runs

    !> One foundation; that its stretch has a length is seen when its ends are points
    pure subroutine check_foundation(f, points, first, last, law, here, end, error)
        type(foundation_type), intent(in) :: f
        !> Points of the tables of all foundations, and which of them are those of this one, by quantity
        type(ground_point_type), intent(in) :: points(:)
        integer, intent(in) :: first(:), last(:)
        type(ground_law_point_type), intent(in) :: law(:)
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: k(2), gap(2), right(parameters_of_law)
        logical :: has(quantities), with_modulus, with_law
        integer :: i

        call check_stretch(f%from, f%to, here, end, error)
        if (allocated(error)) return
        k = [f%k, at_right(f%k, f%k_to)]
        gap = [f%gap, at_right(f%gap, f%gap_to)]
        right = at_right(f%parameter, f%parameter_to)
        has = last >= first
        with_modulus = any(k > 0.0_wp) .or. has(gapbeam_table_of_k)
        with_law = size(law) > 0 .or. f%law /= gapbeam_law_by_points
        if (any(k > huge(1.0_wp)) .and. minval(k) <= huge(1.0_wp)) then
            call refuse_entry(error, here, "k", bad_law, "rigid ground is rigid all along, got inf at one end only; give two "// &
                              "foundations")
        else if (any(k > huge(1.0_wp)) .and. f%side == gapbeam_both) then
            call refuse_entry(error, here, "side", bad_law, "rigid ground holds the beam one way only; give side below or above")
        else if (.not. all(k >= 0.0_wp)) then
            call refuse_number(error, here, "k", k(merge(2, 1, k(1) >= 0.0_wp)), "a finite number, 0 or more")
        else if (with_law .and. with_modulus) then
            call refuse_entry(error, here, "", bad_law, "has both k and law; give one of the two")
        else if (size(law) > 0 .and. f%law /= gapbeam_law_by_points) then
            call refuse_entry(error, here, "law", bad_law, "has both points and parameters; give one of the two")
        else if (.not. (with_law .or. with_modulus)) then
            call refuse_entry(error, here, "k", bad_law, "with a modulus of 0 it never carries; remove it")
        else if (all(f%side /= [gapbeam_both, gapbeam_below, gapbeam_above])) then
            call refuse_entry(error, here, "side", not_expected, &
                              "expected 0 (both), 1 (below) or -1 (above), got "//trim(whole(f%side)))
        else if (.not. all(abs(gap) <= huge(1.0_wp))) then
            call refuse_number(error, here, "gap", gap(merge(2, 1, abs(gap(1)) <= huge(1.0_wp))), "a finite number")
        else if (has(gapbeam_table_of_gap) .and. any(abs(gap) > 0.0_wp)) then
            call refuse_entry(error, here, "", bad_law, "has both gap and profile; give one of the two")
        else if (has(gapbeam_table_of_k) .and. any(k > 0.0_wp)) then
            call refuse_entry(error, here, "k", bad_law, "is given by numbers and by a table; give one of the two")
        end if
        if (.not. allocated(error)) call check_law_kind(f%law, here, error)
        if (.not. allocated(error)) call check_table(points(first(2):last(2)), gapbeam_table_of_gap, f%law, here, error)
        if (.not. allocated(error)) call check_law(law, here, error)
        if (.not. allocated(error)) call check_table(points(first(1):last(1)), gapbeam_table_of_k, f%law, here, error)
        do i = 1, parameters_of_law
            if (allocated(error)) return
            associate (q => gapbeam_table_of_parameter + i - 1)
                if (i > parameters_of(f%law)) then
                    if (has(q)) call refuse_entry(error, here, "law", bad_law, "has no parameter "//trim(whole(i))// &
                                                  ", of which there is a table; leave it out")
                else if (.not. has(q)) then
                    call check_parameter(f%law, i, [f%parameter(i), right(i)], here, error)
                else if (any(abs([f%parameter(i), right(i)]) > 0.0_wp)) then
                    call refuse_entry(error, here, trim(key_of_parameter(f%law, i)), bad_law, &
                                      "is given by numbers and by a table; give one of the two")
                else
                    call check_table(points(first(q):last(q)), q, f%law, here, error)
                end if
            end associate
        end do
        if (f%law == gapbeam_law_by_points .or. allocated(error) .or. any(has(gapbeam_table_of_parameter:))) return
        call check_parameters(f%law, f%parameter, right, "", here, error)
    end subroutine check_foundation

    !> The points of a table
    pure subroutine check_table(points, quantity, law, here, error)
        type(ground_point_type), intent(in) :: points(:)
        !> Of what it is, and the law of the foundation
        integer, intent(in) :: quantity, law
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(out) :: error
        character(len=:), allocatable :: key
        integer :: i, parameter
        logical :: steps, signed

        parameter = quantity - gapbeam_table_of_parameter + 1
        steps = quantity /= gapbeam_table_of_gap
        signed = .not. steps .or. may_be_negative(law, parameter)
        if (quantity == gapbeam_table_of_k) then
            key = "k"
        else if (quantity == gapbeam_table_of_gap) then
            key = "profile"
        else
            key = trim(key_of_parameter(law, parameter))
        end if
        do i = 1, size(points)
            associate (x => points(i)%x, value => points(i)%value, before => points(max(1, i - 1))%x)
                if (.not. (abs(x) <= huge(x) .and. abs(value) <= huge(x))) then
                    call refuse_point(error, here, key, i, "expected finite numbers, got "//trim(pair(x, value)))
                else if (value < 0.0_wp .and. .not. signed) then
                    call refuse_point(error, here, key, i, "expected a value of 0 or more, got "//trim(shown(value))// &
                                      " at x = "//trim(shown(x)))
                else if (x < before) then
                    call refuse_point(error, here, key, i, "the places go back to x = "//trim(shown(x))// &
                                      ", after "//trim(shown(before))//"; give them in ascending order")
                else if (i > 1 .and. .not. steps .and. is_near(x, before)) then
                    call refuse_point(error, here, key, i, "there is a point at x = "//trim(shown(x))// &
                                      " already; leave one out, or give a step two places")
                else if (i > 2 .and. is_near(x, points(max(1, i - 2))%x)) then
                    call refuse_point(error, here, key, i, "there are two points at x = "//trim(shown(x))// &
                                      " already, which are a step; leave one out")
                end if
            end associate
            if (allocated(error)) return
        end do
        if (size(points) == 0 .or. quantity == gapbeam_table_of_gap .or. law == gapbeam_law_cubic .or. parameter > 2) return
        if (any(points%value > 0.0_wp)) return
        call refuse_entry(error, here, key, bad_law, "its values are all 0, so it never carries; remove the foundation")

    end subroutine check_table

    !> Are two points at one place
    elemental function is_near(x, before)
        real(wp), intent(in) :: x, before
        logical :: is_near

        is_near = x - before <= position_tolerance*max(abs(x), abs(before))
    end function is_near

    !> How many points a law has at a place
    pure function points_of_law(points) result(number)
        !> Of one foundation
        type(ground_law_point_type), intent(in) :: points(:)
        integer :: number

        number = 0
        if (size(points) == 0) return
        number = findloc([abs(points%x - points(1)%x) > 0.0_wp, .true.], .true., 1) - 1
    end function points_of_law

    !> The points of a law, at one place after the other
    pure subroutine check_law(points, here, error)
        type(ground_law_point_type), intent(in) :: points(:)
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: before(2)
        integer :: i, begins

        before(:) = 0.0_wp
        begins = 1
        do i = 1, size(points)
            associate (d => points(i)%displacement, f => points(i)%force, x => points(i)%x, last => points(max(1, i - 1))%x)
                if (abs(x - last) > 0.0_wp) then
                    call check_place(points, begins, i, here, error)
                    if (allocated(error)) return
                    begins = i
                    before(:) = 0.0_wp
                end if
                if (.not. (abs(d) <= huge(d) .and. abs(f) <= huge(f) .and. abs(x) <= huge(x))) then
                    call say(error, "expected finite numbers, got "//trim(pair(d, f)))
                else if (d < before(1)) then
                    call say(error, "the displacements go back at "//trim(pair(d, f))//", after "//trim(shown(before(1)))// &
                             "; give them in ascending order")
                else if (f < 0.0_wp) then
                    call say(error, "the force is below zero at "//trim(pair(d, f))//"; ground that pushes cannot pull")
                else if (abs(f - before(2)) > 0.0_wp .and. .not. abs(f - before(2))/huge(f) < d - before(1)) then
                    call say(error, "ground has no vertical piece, as at "//trim(pair(d, f))//"; give a steep slope")
                else if (.not. d > before(1)) then
                    call say(error, "the point "//trim(pair(d, f))//" stands there twice, or at the origin; leave it out")
                else if (f < before(2) .and. is_last(i)) then
                    call say(error, "it ends falling, so its force would become negative beyond "//trim(pair(d, f))// &
                             "; add a point from which on it stays")
                end if
                if (allocated(error)) return
                before(:) = [d, f]
            end associate
        end do
        if (size(points) == 0) return
        if (begins > 1) call check_place(points, begins, size(points) + 1, here, error)
        if (allocated(error) .or. any(points%force > 0.0_wp)) return
        call refuse_entry(error, here, "law", bad_law, "its force stays 0, so it never carries; remove the foundation")

    contains

        !> Is a point the last one at its place
        pure function is_last(number)
            integer, intent(in) :: number
            logical :: is_last

            is_last = number == size(points)
            if (.not. is_last) is_last = abs(points(number + 1)%x - points(number)%x) > 0.0_wp
        end function is_last

        !> What is wrong with the point at hand
        pure subroutine say(found, problem)
            type(error_type), allocatable, intent(out) :: found
            character(len=*), intent(in) :: problem

            call refuse_point(found, here, "law", i, problem)
        end subroutine say

    end subroutine check_law

    !> The laws at two places beside each other, at the end of the points of the first
    pure subroutine check_place(points, begins, next, here, error)
        type(ground_law_point_type), intent(in) :: points(:)
        !> Its first point, and that of the next place
        integer, intent(in) :: begins, next
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(out) :: error

        associate (number => points_of_law(points), x => points(begins)%x)
            if (next - begins /= number) then
                call refuse_point(error, here, "law.points", begins, "the law at x = "//trim(shown(x))//" has "// &
                                  trim(whole(next - begins))//" points, that at x = "//trim(shown(points(1)%x))//" has "// &
                                  trim(whole(number))//"; give as many at every place")
                return
            end if
        end associate
        if (next > size(points)) return
        associate (x => points(next)%x, before => points(begins)%x)
            if (x < before) then
                call refuse_point(error, here, "law.x", next, "the places go back to x = "//trim(shown(x))//", after "// &
                                  trim(shown(before))//"; give them in ascending order")
            else if (is_near(x, before)) then
                call refuse_point(error, here, "law.x", next, "there is a law at x = "//trim(shown(before))// &
                                  " already; leave one out, or give a step two places")
            end if
        end associate
    end subroutine check_place

    !> Refuse a point of a table or a law
    pure subroutine refuse_point(error, here, key, number, problem)
        type(error_type), allocatable, intent(out) :: error
        type(entry_type), intent(in) :: here
        !> Table or law, the point in it, from 1, and what is wrong
        character(len=*), intent(in) :: key, problem
        integer, intent(in) :: number

        call refuse(error, here%table, here%number, here%count, bad_law, key, "point "//trim(whole(number))//": "//problem, number)
    end subroutine refuse_point

end module gapbeam_check_foundations

!> Checks of the laws of foundations that are given by parameters.
module gapbeam_check_ground_laws
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: cubic_rounding
    use gapbeam_error, only: error_type
    use gapbeam_laws, only: law_by_points, law_plastic, law_hardening, law_cubic, parameters_of_law, key_of_parameter
    use gapbeam_words, only: shown, whole
    use gapbeam_input_error, only: not_expected, bad_law
    use gapbeam_check, only: entry_type, refuse_entry
    implicit none
    private
    public :: check_law_kind, check_parameter, check_parameters, may_be_negative

contains

    !> Is there such a law
    pure subroutine check_law_kind(law, here, error)
        integer, intent(in) :: law
        type(entry_type), intent(in) :: here
        !> Bad input
        type(error_type), allocatable, intent(out) :: error

        if (law >= law_by_points .and. law <= law_cubic) return
        call refuse_entry(error, here, "law", not_expected, "expected 0 to "//trim(whole(law_cubic))//", got "//trim(whole(law)))
    end subroutine check_law_kind

    !> May a parameter be below 0
    elemental function may_be_negative(law, number) result(may)
        integer, intent(in) :: law, number
        logical :: may

        may = law == law_cubic .and. number == 2
    end function may_be_negative

    !> One parameter of a law alone
    pure subroutine check_parameter(law, number, values, here, error)
        !> The law, the parameter, and what it is at both ends
        integer, intent(in) :: law, number
        real(wp), intent(in) :: values(2)
        type(entry_type), intent(in) :: here
        !> Bad input
        type(error_type), allocatable, intent(out) :: error

        character(len=:), allocatable :: expected

        if (.not. all(abs(values) <= huge(1.0_wp))) then
            expected = "finite numbers"
        else if (any(values < 0.0_wp) .and. .not. may_be_negative(law, number)) then
            expected = "numbers of 0 or more"
        else if (law /= law_cubic .and. number < 3 .and. .not. any(values > 0.0_wp)) then
            expected = "a number above 0 at one end at least"
        else
            return
        end if
        call refuse_entry(error, here, trim(key_of_parameter(law, number)), bad_law, "expected "//expected//", got "// &
                          trim(both_of(values)))
    end subroutine check_parameter

    !> The parameters of a law together, along a stretch on which all of them are linear
    pure subroutine check_parameters(law, left, right, stretch, here, error)
        !> The law, and its parameters at both ends, each possible alone
        integer, intent(in) :: law
        real(wp), intent(in) :: left(:), right(:)
        !> "the stretch from x = ... to x = ...", or "" where it is all of the foundation
        character(len=*), intent(in) :: stretch
        type(entry_type), intent(in) :: here
        !> Bad input
        type(error_type), allocatable, intent(out) :: error

        if (law == law_cubic) then
            call check_cubic(error)
        else if (law == law_hardening) then
            if (.not. max(left(2), right(2)) > 0.0_wp) then
                call say(error, 2, "is 0"//trim(part("all along"))//", where stiffness is not; give a small limit there, "// &
                         "or a stiffness of 0")
            end if
        else if (law /= law_plastic) then
            if ((left(1) > 0.0_wp .and. .not. left(2) > 0.0_wp) .or. (right(1) > 0.0_wp .and. .not. right(2) > 0.0_wp)) then
                call say(error, 2, "is 0 at an end"//trim(part("of"))//" where stiffness is not, where the curve would "// &
                         "have a kink; give a small limit there, or a stiffness of 0")
            end if
        end if

    contains

        !> A law that rises everywhere: 3 k1 k3 >= k2**2 where k2 < 0
        pure subroutine check_cubic(found)
            type(error_type), allocatable, intent(out) :: found
            real(wp) :: from, to, vertex, curvature, change

            if (.not. any([left, right] > 0.0_wp)) then
                call say(found, 1, "expected a number above 0 for k1, k2 or k3")
                return
            end if
            if (.not. min(left(2), right(2)) < 0.0_wp) return
            from = 0.0_wp
            to = 1.0_wp
            if (left(2) > 0.0_wp) from = left(2)/(left(2) - right(2))
            if (right(2) > 0.0_wp) to = left(2)/(left(2) - right(2))
            associate (d => right - left)
                curvature = 2*(3*d(1)*d(3) - d(2)**2)
                change = 3*(left(1)*d(3) + left(3)*d(1)) - 2*left(2)*d(2)
            end associate
            vertex = from
            if (curvature > 0.0_wp) then
                if (-change < curvature) vertex = min(to, max(from, -change/curvature))
            end if
            if (rises(from) .and. rises(to) .and. rises(vertex)) return
            call say(found, 2, "with k2 below -sqrt(3*k1*k3) the force falls"//trim(part("along"))// &
                     "; softening ground is not available in this version")
        end subroutine check_cubic

        !> Does the law rise at a share of the way
        pure function rises(share)
            real(wp), intent(in) :: share
            logical :: rises
            real(wp) :: k(parameters_of_law)

            k = left*(1 - share) + right*share
            rises = k(2)**2 <= 3*k(1)*k(3)*(1 + cubic_rounding)
        end function rises

        !> The stretch in a sentence, if it is not all of the foundation, blanks behind it
        pure function part(preposition) result(words)
            character(len=*), intent(in) :: preposition
            character(len=160) :: words

            words = ""
            if (stretch /= "") words = " "//preposition//" "//stretch
        end function part

        !> What is wrong with a parameter
        pure subroutine say(found, number, problem)
            type(error_type), allocatable, intent(out) :: found
            integer, intent(in) :: number
            character(len=*), intent(in) :: problem

            call refuse_entry(found, here, trim(key_of_parameter(law, number)), bad_law, problem)
        end subroutine say

    end subroutine check_parameters

    !> One number as text, or two if they differ, blanks behind it
    pure function both_of(values) result(text)
        real(wp), intent(in) :: values(2)
        character(len=64) :: text

        text = shown(values(1))
        if (values(1) < values(2) .or. values(1) > values(2)) text = "["//trim(shown(values(1)))//", "//trim(shown(values(2)))//"]"
    end function both_of

end module gapbeam_check_ground_laws

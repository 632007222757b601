!> Are the laws of foundations that are given by parameters possible
module gapbeam_check_ground_laws
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_layers, only: law_by_points, law_plastic, law_hardening, law_cubic, parameters_of_law
    use gapbeam_words, only: shown, whole
    use gapbeam_refusal, only: not_expected, bad_law
    use gapbeam_check, only: entry_type, refuse_entry
    implicit none
    private
    public :: check_ground_law

    !> Parameters as scenes call them
    character(len=*), parameter :: names(parameters_of_law) = [character(len=9) :: "stiffness", "limit", "slope"], &
                                   names_of_cubic(parameters_of_law) = [character(len=9) :: "k1", "k2", "k3"]
    !> By so much k2 may be less than what is allowed: decimals are rounded
    real(wp), parameter :: rounding = 2.0_wp**(-50)

contains

    !> The law of one foundation
    pure subroutine check_ground_law(law, left, right, here, error)
        !> The law, and its parameters at both ends
        integer, intent(in) :: law
        real(wp), intent(in) :: left(:), right(:)
        type(entry_type), intent(in) :: here
        !> Bad input
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: values(2)
        integer :: i, used

        if (law == law_by_points) return
        if (law < law_by_points .or. law > law_cubic) then
            call refuse_entry(error, here, "law", not_expected, &
                              "expected 0 to "//trim(whole(law_cubic))//", got "//trim(whole(law)))
            return
        end if
        used = merge(parameters_of_law, 2, law == law_cubic .or. law == law_hardening)
        do i = 1, used
            values = [left(i), right(i)]
            if (.not. all(abs(values) <= huge(1.0_wp))) then
                call say(error, i, "expected finite numbers, got "//trim(both_of(values)))
            else if (any(values < 0.0_wp) .and. .not. (law == law_cubic .and. i == 2)) then
                call say(error, i, "expected numbers of 0 or more, got "//trim(both_of(values)))
            else if (law /= law_cubic .and. i < 3 .and. .not. any(values > 0.0_wp)) then
                call say(error, i, "expected a number above 0 at one end at least, got "//trim(both_of(values)))
            end if
            if (allocated(error)) return
        end do
        if (law == law_cubic) then
            call check_cubic(error)
        else if (law /= law_plastic .and. law /= law_hardening) then
            if ((left(1) > 0.0_wp .and. .not. left(2) > 0.0_wp) .or. (right(1) > 0.0_wp .and. .not. right(2) > 0.0_wp)) then
                call say(error, 2, "is 0 at an end where stiffness is not, where the curve would have a kink; "// &
                         "give a small limit there, or a stiffness of 0")
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
            call say(found, 2, "with k2 below -sqrt(3*k1*k3) the force falls; softening ground is not available in this version")
        end subroutine check_cubic

        !> Does the law rise at a share of the way
        pure function rises(share)
            real(wp), intent(in) :: share
            logical :: rises
            real(wp) :: k(parameters_of_law)

            k = left*(1 - share) + right*share
            rises = k(2)**2 <= 3*k(1)*k(3)*(1 + rounding)
        end function rises

        !> What is wrong with a parameter
        pure subroutine say(found, number, problem)
            type(error_type), allocatable, intent(out) :: found
            integer, intent(in) :: number
            character(len=*), intent(in) :: problem

            if (law == law_cubic) then
                call refuse_entry(found, here, "law."//trim(names_of_cubic(number)), bad_law, problem)
            else
                call refuse_entry(found, here, "law."//trim(names(number)), bad_law, problem)
            end if
        end subroutine say

    end subroutine check_ground_law

    !> One number as text, or two if they differ, blanks behind it
    pure function both_of(values) result(text)
        real(wp), intent(in) :: values(2)
        character(len=64) :: text

        text = shown(values(1))
        if (values(1) < values(2) .or. values(1) > values(2)) text = "["//trim(shown(values(1)))//", "//trim(shown(values(2)))//"]"
    end function both_of

end module gapbeam_check_ground_laws

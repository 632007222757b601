!> Laws of supports by name: checked, and as points.
module gapbeam_support_laws
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: cubic_rounding
    use gapbeam_error, only: error_type, failed
    use gapbeam_memory, only: reserve_memory, for_laws
    use gapbeam_words, only: shown, whole
    use gapbeam_laws, only: law_by_points, law_plastic, law_hardening, law_hyperbolic, law_tanh, law_cubic, law_power, &
        law_brittle, parameters_of, key_of_parameter, is_smooth, law_points
    use gapbeam_scene, only: model_type, support_type, law_point_type, gapbeam_elastic
    use gapbeam_input_error, only: refuse, of_supports, bad_law
    implicit none
    private
    public :: gather_points

    !> Least value of a parameter: above 0, 0, or any; the same in words, with a blank before them
    integer, parameter :: above_zero = 1, not_negative = 2, any_sign = 3
    character(len=*), parameter :: bounds(any_sign) = [character(len=14) :: " above 0", " of 0 or more", ""]

    !> The points of a law by name
    type :: made_type
        real(wp), allocatable :: points(:, :)
    end type made_type

contains

    !> Points of the laws of all supports: those that are given, then those of laws by name
    subroutine gather_points(model, points, error)
        !> With all arrays allocated
        type(model_type), intent(in) :: model
        type(law_point_type), allocatable, intent(out) :: points(:)
        !> A law that is impossible, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(made_type), allocatable :: made(:)
        integer :: i, k, n, stat

        n = count(model%supports%law /= law_by_points)
        allocate (made(merge(size(model%supports), 0, n > 0)), stat=stat)
        if (stat == 0) call reserve_memory(for_laws, 0, 0, n, error)
        if (failed(stat, error)) return
        n = size(model%law)
        do k = 1, size(made)
            if (model%supports(k)%law == law_by_points) cycle
            call check_law(model, k, error)
            if (allocated(error)) return
            made(k)%points = law_points(model%supports(k)%law, model%supports(k)%parameter)
            n = n + size(made(k)%points, 2)
        end do
        allocate (points(n), stat=stat)
        if (failed(stat, error)) return
        n = size(model%law)
        points(:n) = model%law
        do k = 1, size(made)
            if (.not. allocated(made(k)%points)) cycle
            do i = 1, size(made(k)%points, 2)
                points(n + i) = law_point_type(k, made(k)%points(1, i), made(k)%points(2, i))
            end do
            n = n + size(made(k)%points, 2)
        end do
    end subroutine gather_points

    !> The law of a support by its name and parameters
    subroutine check_law(model, k, error)
        type(model_type), intent(in) :: model
        !> The support
        integer, intent(in) :: k
        !> Bad input
        type(error_type), allocatable, intent(out) :: error
        integer :: number
        real(wp) :: least

        associate (s => model%supports(k))
            if (.not. any(s%law == [law_plastic, law_hardening, law_hyperbolic, law_tanh, law_cubic, law_power, law_brittle])) then
                call say("law", "expected 0 to "//trim(whole(law_cubic))//", "//trim(whole(law_power))//" or "// &
                         trim(whole(law_brittle))//", got "//trim(whole(s%law)))
            else if (any(model%law%support == k)) then
                call say("law", "is given by name and by points; give one of the two")
            end if
            do number = 1, parameters_of(s%law)
                if (.not. allocated(error)) call check_number(s, number)
            end do
            if (allocated(error)) return
            if (s%law == law_cubic) then
                least = -2*sqrt(s%parameter(1))*sqrt(s%parameter(3)) + 0.0_wp
                if (s%parameter(2) < least*(1 + cubic_rounding)) then
                    call say("law.k2", "expected -2*sqrt(k1*k3) = "//trim(shown(least))//" or more, since a support that "// &
                             "pushes cannot pull, got "//trim(shown(s%parameter(2))))
                else if (.not. any(abs(s%parameter) > 0.0_wp)) then
                    call say("law.k1", "expected a number above 0 for k1, k2 or k3, got 0")
                end if
            end if
            if (allocated(error) .or. s%unloading == gapbeam_elastic .or. .not. is_smooth(s%law)) return
            call say("unloading", "a smooth law unloads along itself; give its points for another unloading")
        end associate

    contains

        !> What is wrong
        subroutine say(key, problem)
            character(len=*), intent(in) :: key, problem

            call refuse(error, of_supports, k, size(model%supports), bad_law, key, problem)
        end subroutine say

        !> One parameter alone
        subroutine check_number(s, number)
            type(support_type), intent(in) :: s
            integer, intent(in) :: number
            logical :: finite, right

            finite = is_smooth(s%law) .or. number == 2
            associate (value => s%parameter(number))
                select case (least_of(s%law, number))
                case (above_zero)
                    right = value > 0.0_wp
                case (not_negative)
                    right = value >= 0.0_wp
                case default
                    right = value >= -huge(value)
                end select
                if (finite .and. right) right = value <= huge(value)
                if (.not. right) call say(trim(key_of_parameter(s%law, number)), "expected "// &
                                          trim(merge("a finite number", "a number       ", finite))// &
                                          trim(bounds(least_of(s%law, number)))//", got "//trim(shown(value)))
            end associate
        end subroutine check_number

    end subroutine check_law

    !> The least value of a parameter
    elemental function least_of(law, number) result(least)
        integer, intent(in) :: law, number
        integer :: least

        least = above_zero
        if (law == law_cubic) least = merge(any_sign, not_negative, number == 2)
        if (law == law_hardening .and. number == 3) least = not_negative
    end function least_of

end module gapbeam_support_laws

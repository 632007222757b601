!> Reactions and openings as affine functions of the load factor while one contact state acts.
!> v = v0 + factor v1, v0 from the dead loads and the contact levels, v1 from the live loads alone.
module gapbeam_affine_response
    use gapbeam_kinds, only: wp
    use gapbeam_law_margins, only: margin_in_scheme
    use gapbeam_law_adapters, only: drop_level
    use gapbeam_model, only: beam_type, drop_loads
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_tolerances, only: sign_width, rounding_unit
    implicit none
    private
    public :: lines_type, new_lines, without_dead_loads, drop_live
    public :: response_type, response_of, value_at, width_at, zero_of, falls, rises, stays_at_zero

    !> Solutions of one scheme over the load factor
    type :: lines_type
        !> The beam without its dead loads and gaps
        type(beam_type) :: incremental
        !> v0 and v1
        type(workspace_type) :: dead, live
    end type lines_type

    !> Force with which a support pushes, or its distance to contact, and the errors of the coefficients
    type :: response_type
        real(wp) :: v0 = 0.0_wp, v1 = 0.0_wp, error_of_v0 = 0.0_wp, error_of_v1 = 0.0_wp
    end type response_type

contains

    !> Room for the solutions of a beam, their loads set
    subroutine new_lines(beam, lines)
        type(beam_type), intent(in) :: beam
        !> Nothing solved yet
        type(lines_type), intent(out) :: lines

        call without_dead_loads(beam, lines%incremental)
        call new_workspace(beam, lines%dead)
        call new_workspace(lines%incremental, lines%live)
        call set_loads(beam, 0.0_wp, lines%dead)
        call set_loads(lines%incremental, 1.0_wp, lines%live)
    end subroutine new_lines

    !> The beam of v1: dead loads and contact levels are left out
    subroutine without_dead_loads(beam, incremental)
        type(beam_type), intent(in) :: beam
        !> The same without them
        type(beam_type), intent(out) :: incremental

        incremental = beam
        call drop_level(incremental%supports)
        call drop_loads(incremental, 1)
    end subroutine without_dead_loads

    !> The beam while its dead loads are put on: they grow with the factor, and there is no other load
    pure subroutine drop_live(beam, growing)
        type(beam_type), intent(in) :: beam
        !> The same with its dead loads as live ones
        type(beam_type), intent(out) :: growing

        growing = beam
        growing%force(2, :) = beam%force(1, :)
        growing%couple(2, :) = beam%couple(1, :)
        associate (links => growing%links, from => beam%links)
            links%turn_a(2) = from%turn_a(1)
            links%turn_b(2) = from%turn_b(1)
            links%shear_a(2) = from%shear_a(1)
            links%shear_b(2) = from%shear_b(1)
            links%load_sum(2) = from%load_sum(1)
            links%turn_sum(2) = from%turn_sum(1)
        end associate
        call drop_loads(growing, 1)
    end subroutine drop_live

    !> The line of a support
    pure function response_of(beam, closed, k, lines) result(response)
        type(beam_type), intent(in) :: beam
        !> The scheme, and the number of the support
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        !> Solved with the scheme at hand
        type(lines_type), intent(in) :: lines
        type(response_type) :: response

        associate (i => beam%supports(k)%node, dead => lines%dead, live => lines%live)
            call margin_in_scheme(beam%supports, closed, k, dead%answers(i)%deflection, dead%deflection_size(i), dead%reaction, &
                                  dead%reaction_error, response%v0, response%error_of_v0)
            call margin_in_scheme(lines%incremental%supports, closed, k, live%answers(i)%deflection, live%deflection_size(i), &
                                  live%reaction, live%reaction_error, response%v1, response%error_of_v1)
        end associate
        response%error_of_v0 = sign_width*response%error_of_v0
        response%error_of_v1 = sign_width*response%error_of_v1
    end function response_of

    !> Value at a factor
    elemental function value_at(response, factor) result(value)
        type(response_type), intent(in) :: response
        real(wp), intent(in) :: factor
        real(wp) :: value

        value = response%v0 + factor*response%v1
    end function value_at

    !> How near to zero counts as zero at a factor
    elemental function width_at(response, factor) result(width)
        type(response_type), intent(in) :: response
        real(wp), intent(in) :: factor
        real(wp) :: width

        width = max(response%error_of_v0 + abs(factor)*response%error_of_v1, &
                    rounding_unit*max(abs(response%v0), abs(factor*response%v1)))
    end function width_at

    !> The factor at which a line that is not level is zero
    elemental function zero_of(response) result(zero)
        type(response_type), intent(in) :: response
        real(wp) :: zero

        zero = -response%v0/response%v1
    end function zero_of

    !> Does a line fall as the factor grows
    elemental function falls(response)
        type(response_type), intent(in) :: response
        logical :: falls

        falls = response%v1 < -response%error_of_v1
    end function falls

    !> Does a line rise as the factor grows
    elemental function rises(response)
        type(response_type), intent(in) :: response
        logical :: rises

        rises = response%v1 > response%error_of_v1
    end function rises

    !> Is a line zero, and does it stay so
    elemental function stays_at_zero(response, factor) result(stays)
        type(response_type), intent(in) :: response
        real(wp), intent(in) :: factor
        logical :: stays

        stays = .not. (falls(response) .or. rises(response)) .and. abs(value_at(response, factor)) <= width_at(response, factor)
    end function stays_at_zero

end module gapbeam_affine_response

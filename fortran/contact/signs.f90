!> Which supports are wrong in a scheme, from its deflections and moments alone, as long as nothing is near zero.
!>
!> That is so in nearly every scheme of a search, and costs a small part of what it takes to find reactions and how far rounding
!> errors reach. What is near zero is left to gapbeam_law, with all that.
module gapbeam_signs
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_law, only: has_laws, is_rigid, may_change
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type
    implicit none
    private
    public :: sign_type, prepare_signs, find_clearly_wrong

    !> Far above all rounding errors
    real(wp), parameter :: near_zero = 2.0_wp**19*epsilon(1.0_wp)

    !> The supports of a beam that may change, from left to right
    type :: sign_type
        !> Their numbers and nodes
        integer, allocatable :: support(:), node(:)
        !> 1 or -1, contact levels, and what of these counts as zero
        real(wp), allocatable :: side(:), contact(:), zero(:)
        !> Are they rigid; are there others at the node
        logical, allocatable :: rigid(:), in_company(:)
        !> Has any support a law: which of its pieces acts is for gapbeam_law
        logical :: with_laws = .false.
    end type sign_type

contains

    !> Take what signs need from the supports of a beam
    pure subroutine prepare_signs(beam, signs)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> Its supports that may change
        type(sign_type), intent(out) :: signs
        integer :: j, m, number

        number = count(may_change(beam%supports))
        allocate (signs%support(number), signs%node(number), signs%side(number), signs%contact(number), signs%zero(number), &
                  signs%rigid(number), signs%in_company(number))
        signs%with_laws = has_laws(beam%supports)
        m = 0
        do j = 1, size(beam%order)
            associate (s => beam%supports(beam%order(j)))
                if (.not. may_change(s)) cycle
                m = m + 1
                signs%support(m) = beam%order(j)
                signs%node(m) = s%node
                signs%side(m) = s%side
                signs%contact(m) = s%contact
                signs%zero(m) = near_zero*abs(s%contact)
                signs%rigid(m) = is_rigid(s)
                signs%in_company(m) = beam%first(s%node + 1) - beam%first(s%node) > 1
            end associate
        end do
    end subroutine prepare_signs

    !> The wrong ones, as long as nothing is near zero
    pure subroutine find_clearly_wrong(beam, signs, closed, work, wrong, number, doubtful)
        !> The beam, not on the ground, and its supports that may change
        type(beam_type), intent(in) :: beam
        type(sign_type), intent(in) :: signs
        !> The scheme, solved by solve_deflections of gapbeam_system
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> Which are wrong, shape (size(closed)), and how many; of no use where something is doubtful
        logical, intent(out) :: wrong(:)
        integer, intent(out) :: number
        !> Something is so near zero that only find_wrong of gapbeam_rules can tell, or no number
        logical, intent(out) :: doubtful
        real(wp) :: force, margin, zero, least_force, least_deflection
        integer :: j, n, k

        if (checked) then
            call require(.not. allocated(beam%ground) .and. size(closed) == size(beam%supports), "find_clearly_wrong: beam")
        end if
        wrong(:) = .false.
        number = 0
        doubtful = signs%with_laws
        if (doubtful) return
        ! No rounding error that find_wrong allows for can be larger than these times some epsilon
        call find_largest_sizes(beam, work, least_force, least_deflection)
        least_force = near_zero*least_force
        least_deflection = near_zero*least_deflection
        n = size(beam%links)
        associate (a => work%answers)
            do j = 1, size(signs%support)
                k = signs%support(j)
                associate (i => signs%node(j))
                    if (signs%rigid(j) .and. closed(k)) then
                        ! Forces of several supports at one node are for share_forces
                        doubtful = signs%in_company(j)
                        if (doubtful) return
                        force = work%loads(i)%shear + work%ease(i)*(work%reference(i) - a(i)%deflection)
                        if (i > 0) force = force - (a(i)%moment_left - a(i - 1)%moment_right)*work%inverse(i)
                        if (i < n) force = force + (a(i + 1)%moment_left - a(i)%moment_right)*work%inverse(i + 1)
                        margin = signs%side(j)*force
                        zero = least_force
                    else
                        margin = signs%side(j)*(a(i)%deflection - signs%contact(j))
                        zero = least_deflection + signs%zero(j)
                    end if
                end associate
                doubtful = .not. abs(margin) > zero
                if (doubtful) return
                wrong(k) = closed(k) .neqv. margin > 0.0_wp
                if (wrong(k)) number = number + 1
            end do
        end associate
    end subroutine find_clearly_wrong

    !> The largest of the sizes that find_own_sizes of gapbeam_reactions finds
    pure subroutine find_largest_sizes(beam, work, shear, deflection)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(in) :: work
        real(wp), intent(out) :: shear, deflection
        real(wp) :: turn, moment, at_node
        integer :: i

        associate (a => work%answers)
            shear = maxval(work%load_size)
            deflection = abs(a(0)%deflection)
            at_node = 0.0_wp
            do i = 1, size(beam%links)
                turn = work%turn_size(i) + (work%level(i) + work%level(i - 1))*work%inverse(i)
                moment = max(abs(a(i - 1)%moment_right), abs(a(i)%moment_left), turn*work%fixity(i))
                shear = max(shear, 2*moment*work%inverse(i))
                deflection = max(deflection, work%reach(i)*moment)
                at_node = max(at_node, abs(a(i)%deflection))
            end do
            deflection = max(deflection, at_node)
        end associate
    end subroutine find_largest_sizes

end module gapbeam_signs

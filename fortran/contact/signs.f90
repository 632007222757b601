!> Wrong supports by the signs of deflections and moments alone, as long as none is near zero.
!>
!> That is so in nearly every scheme of a search, and costs a small part of what it takes to find reactions and how far rounding
!> errors reach. What is near zero is left to gapbeam_law, with all that.
module gapbeam_signs
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: near_zero
    use gapbeam_require, only: checked, require
    use gapbeam_law, only: is_rigid
    use gapbeam_law_margins, only: may_change
    use gapbeam_model, only: beam_type, has_other_supports
    use gapbeam_workspace, only: workspace_type
    implicit none
    private
    public :: sign_type, prepare_signs, find_clearly_wrong

    !> Supports from left to right
    type :: group_type
        !> Their numbers and nodes
        integer, allocatable :: support(:), node(:)
        !> 1 or -1, contact levels, and what of these counts as zero
        real(wp), allocatable :: side(:), contact(:), zero(:)
    end type group_type

    !> The supports of a beam that may change
    type :: sign_type
        !> Rigid ones and others
        type(group_type) :: rigid, elastic
        !> Has any support a law, or are there several at a node of which one is rigid: which piece acts, and whose a force is, is
        !> for gapbeam_law
        logical :: unclear = .false.
        !> Bounds of the sizes of shears and deflections that loads, imposed rotations and contact levels make
        real(wp) :: shear = 0.0_wp, deflection = 0.0_wp
        !> Room for moments and deflections, shape (0:n)
        real(wp), allocatable :: moment(:), w(:)
    end type sign_type

contains

    !> Take what signs need from a beam and its loads
    pure subroutine prepare_signs(beam, work, signs)
        type(beam_type), intent(in) :: beam
        !> Its loads, by set_loads
        type(workspace_type), intent(in) :: work
        !> Its supports that may change
        type(sign_type), intent(out) :: signs
        real(wp) :: farthest, moment
        integer :: i

        call take_group(beam, .true., signs%rigid)
        call take_group(beam, .false., signs%elastic)
        associate (nodes => signs%rigid%node)
            signs%unclear = has_other_supports(beam)
            if (.not. signs%unclear) signs%unclear = any(beam%first(nodes + 1) - beam%first(nodes) > 1)
        end associate
        farthest = 0.0_wp
        if (size(beam%supports) > 0) farthest = maxval(abs(beam%supports%contact))
        signs%shear = maxval(work%load_size)
        do i = 1, size(beam%links)
            moment = (work%turn_size(i) + 2*farthest*work%inverse(i))*work%fixity(i)
            signs%shear = max(signs%shear, 2*moment*work%inverse(i))
            signs%deflection = max(signs%deflection, work%reach(i)*moment)
        end do
        allocate (signs%moment(0:size(beam%links)), signs%w(0:size(beam%links)))
    end subroutine prepare_signs

    !> Take the rigid supports that may change, or the others
    pure subroutine take_group(beam, rigid, group)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: rigid
        type(group_type), intent(out) :: group
        integer :: j, m, pass

        do pass = 1, 2
            m = 0
            do j = 1, size(beam%order)
                associate (s => beam%supports(beam%order(j)))
                    if (is_rigid(s) .neqv. rigid) cycle
                    if (.not. may_change(s)) cycle
                    m = m + 1
                    if (pass == 1) cycle
                    group%support(m) = beam%order(j)
                    group%node(m) = s%node
                    group%side(m) = s%side
                    group%contact(m) = s%contact
                    group%zero(m) = near_zero*abs(s%contact)
                end associate
            end do
            if (pass == 1) allocate (group%support(m), group%node(m), group%side(m), group%contact(m), group%zero(m))
        end do
    end subroutine take_group

    !> The wrong ones, as long as nothing is near zero
    pure subroutine find_clearly_wrong(beam, signs, closed, work, wrong, number, doubtful)
        !> The beam, not on the ground
        type(beam_type), intent(in) :: beam
        !> Its supports that may change
        type(sign_type), intent(inout) :: signs
        !> The scheme, solved by solve_deflections of gapbeam_system
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> Which are wrong, shape (size(closed)), and how many; of no use where something is doubtful
        logical, intent(out) :: wrong(:)
        integer, intent(out) :: number
        !> Something is so near zero that only find_wrong of gapbeam_rules can tell, or no number
        logical, intent(out) :: doubtful
        real(wp) :: shear, deflection, force, margin
        integer :: j, k, n

        if (checked) then
            call require(.not. allocated(beam%ground) .and. size(closed) == size(beam%supports), "find_clearly_wrong: beam")
        end if
        n = size(beam%links)
        wrong(:) = .false.
        number = 0
        doubtful = signs%unclear
        if (doubtful) return
        ! No rounding error that find_wrong allows for can be larger than these times some epsilon
        shear = signs%shear
        deflection = signs%deflection
        if (work%plain%has_rows) then
            call judge_elastic(signs%elastic, n, work%plain%moment, work%plain%deflection, work%inverse, work%reach, size(closed), &
                               closed, shear, deflection, wrong, number, doubtful)
        else
            signs%moment(:) = max(abs(work%answers(0:n)%moment_left), abs(work%answers(0:n)%moment_right))
            signs%w(:) = work%answers(0:n)%deflection
            call judge_elastic(signs%elastic, n, signs%moment, signs%w, work%inverse, work%reach, size(closed), closed, shear, &
                               deflection, wrong, number, doubtful)
        end if
        if (doubtful) return
        associate (a => work%answers, s => signs%rigid)
            do j = 1, size(s%support)
                k = s%support(j)
                associate (i => s%node(j))
                    if (closed(k)) then
                        force = work%loads(i)%shear + work%proximal_weight(i)*(work%reference(i) - a(i)%deflection)
                        if (i > 0) force = force - (a(i)%moment_left - a(i - 1)%moment_right)*work%inverse(i)
                        if (i < n) force = force + (a(i + 1)%moment_left - a(i)%moment_right)*work%inverse(i + 1)
                        margin = s%side(j)*force
                        doubtful = .not. abs(margin) > near_zero*shear
                    else
                        margin = s%side(j)*(a(i)%deflection - s%contact(j))
                        doubtful = .not. abs(margin) > near_zero*deflection + s%zero(j)
                    end if
                end associate
                if (doubtful) return
                wrong(k) = closed(k) .neqv. margin > 0.0_wp
                if (wrong(k)) number = number + 1
            end do
        end associate
    end subroutine find_clearly_wrong

    !> Which of the supports of springs, closed or open, are wrong
    pure subroutine judge_elastic(group, n, moment, w, inverse, reach, m, closed, shear, deflection, wrong, number, doubtful)
        type(group_type), intent(in) :: group
        !> Links and supports
        integer, intent(in) :: n, m
        !> Moments and deflections; as in the workspace
        real(wp), intent(in) :: moment(0:n), w(0:n), inverse(n), reach(n)
        logical, intent(in) :: closed(m)
        !> Raised to the largest that find_own_sizes of gapbeam_reactions finds
        real(wp), intent(inout) :: shear, deflection
        logical, intent(inout) :: wrong(m)
        integer, intent(inout) :: number
        logical, intent(out) :: doubtful
        real(wp) :: larger, at_node
        integer :: i

        at_node = abs(w(0))
        do i = 1, n
            larger = max(abs(moment(i - 1)), abs(moment(i)))
            shear = max(shear, 2*larger*inverse(i))
            deflection = max(deflection, reach(i)*larger)
            at_node = max(at_node, abs(w(i)))
        end do
        deflection = max(deflection, at_node)
        associate (g => group)
            call judge(size(g%support), g%support, g%node, g%side, g%contact, g%zero, near_zero*deflection, n, w, m, closed, &
                       wrong, number, doubtful)
        end associate
    end subroutine judge_elastic

    !> The same, array by array
    pure subroutine judge(m, support, node, side, contact, zero, least, n, w, total, closed, wrong, number, doubtful)
        integer, intent(in) :: m, support(m), node(m), n, total
        real(wp), intent(in) :: side(m), contact(m), zero(m), least, w(0:n)
        logical, intent(in) :: closed(total)
        logical, intent(inout) :: wrong(total)
        integer, intent(inout) :: number
        logical, intent(out) :: doubtful
        real(wp) :: margin
        integer :: j

        doubtful = .false.
        do j = 1, m
            margin = side(j)*(w(node(j)) - contact(j))
            doubtful = doubtful .or. .not. abs(margin) > least + zero(j)
            wrong(support(j)) = closed(support(j)) .neqv. margin > 0.0_wp
            number = number + merge(1, 0, wrong(support(j)))
        end do
    end subroutine judge

end module gapbeam_signs

!> The chain along the beam goes on: by its rates, or to other pieces of its links.
!>
!> Where rates stay as they are, displacements and forces are added up only when they are looked at.
module gapbeam_axial_progress
    use gapbeam_kinds, only: wp, qp
    use gapbeam_unloading_quad, only: rewrite_laws
    use gapbeam_axial_chain, only: chain_type, no_way_yet
    implicit none
    private
    public :: advance, change_pieces, change_limit, settle, settle_link, note_rates, note_link, note_point, note_part, make_fine
    public :: values_of

contains

    !> Go on by the rates
    pure subroutine advance(chain, way, at_once)
        type(chain_type), intent(inout) :: chain
        real(qp), intent(in) :: way
        !> Is it the chain that moves, not the load: all of it is added up then
        logical, intent(in) :: at_once
        integer :: l

        if (.not. at_once) then
            chain%clock = chain%clock + way
            if (any(chain%keeps_set)) call settle(chain, [0, size(chain%flexibility)])
        else
            chain%displacement(:) = chain%displacement + way*chain%displacement_rate
            do l = 1, size(chain%first)
                associate (k => chain%first(l))
                    if (chain%rubs(l)) chain%laws(k:k + 1)%contact = chain%displacement(chain%laws(k)%node)
                end associate
            end do
        end if
        if (any(chain%keeps_set)) call move_breakpoints(chain)
    end subroutine advance

    !> Write the laws that keep a set anew from where the links are
    pure subroutine move_breakpoints(chain)
        type(chain_type), intent(inout) :: chain
        real(qp) :: deflection(size(chain%laws)), reaction(size(chain%laws))
        integer :: l

        reaction(:) = 0.0_qp
        do l = 1, size(chain%first)
            associate (k => chain%first(l))
                deflection(k:chain%last(l)) = chain%displacement(chain%laws(k)%node) - chain%moved(l)
                reaction(k) = chain%force(l)
            end associate
        end do
        call rewrite_laws(chain%laws, chain%closed, chain%keeps_set, chain%first_slope, deflection, reaction)
    end subroutine move_breakpoints

    !> Let links go to the pieces beside theirs
    pure subroutine change_pieces(chain, links, steps)
        type(chain_type), intent(inout) :: chain
        !> By next_change
        integer, intent(in) :: links(:), steps(:)
        integer :: i, n

        do i = 1, size(links)
            associate (k => chain%first(links(i)), last => chain%last(links(i)))
                n = count(chain%closed(k:last)) + steps(i)
                chain%closed(k:last) = .false.
                chain%closed(k:k + n - 1) = .true.
                ! No rounding where nothing acts
                if (n == 0 .and. .not. (abs(chain%laws(k)%before) > 0.0_qp .or. abs(chain%laws(k)%force) > 0.0_qp)) then
                    chain%force(links(i)) = 0.0_qp
                end if
            end associate
        end do
    end subroutine change_pieces

    !> Let the limit of a link that rubs have another rate from here on, its point settled: what pushes its point, and what the link
    !> takes, are found anew with the rates of the chain
    pure subroutine change_limit(chain, l, rate)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: l
        real(qp), intent(in) :: rate

        call settle_link(chain, l)
        chain%limit_rate(l) = rate
        chain%slides(l) = .false.
        chain%way(chain%laws(chain%first(l))%node) = no_way_yet
    end subroutine change_limit

    !> Add up what has happened between two points since they were looked at; what is known in double precision goes on
    pure subroutine settle(chain, reach)
        type(chain_type), intent(inout) :: chain
        !> The points, and the bars and links between them
        integer, intent(in) :: reach(2)
        real(qp) :: way
        logical :: whole
        integer :: i, j

        whole = reach(2) - reach(1) == size(chain%flexibility)
        do i = reach(1), reach(2)
            if (.not. chain%coarse(i)) then
                way = chain%clock - chain%since_point(i)
                if (abs(way) > 0.0_qp) chain%displacement(i) = chain%displacement(i) + way*chain%displacement_rate(i)
                chain%since_point(i) = chain%clock
            end if
            if (i == reach(1)) cycle
            if (chain%coarse_bar(i)) cycle
            way = chain%clock - chain%since_bar(i)
            if (abs(way) > 0.0_qp) chain%tension(i) = chain%tension(i) + way*chain%tension_rate(i)
            chain%since_bar(i) = chain%clock
        end do
        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            if (whole .or. .not. chain%slides(chain%in_order(j))) call settle_link(chain, chain%in_order(j))
        end do
    end subroutine settle

    !> The same for a link, its point settled
    pure subroutine settle_link(chain, l)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: l
        real(qp) :: way, limit

        way = chain%clock - chain%since_link(l)
        if (.not. abs(way) > 0.0_qp) return
        chain%since_link(l) = chain%clock
        chain%force(l) = chain%force(l) + way*chain%force_rate(l)
        chain%moved(l) = chain%moved(l) + way*chain%own_rate(l)
        if (.not. chain%rubs(l)) return
        associate (k => chain%first(l))
            limit = max(0.0_qp, chain%laws(k + 1)%force + way*chain%limit_rate(l))
            chain%laws(k)%force = -limit
            chain%laws(k + 1)%force = limit
            chain%laws(k:k + 1)%contact = chain%displacement(chain%laws(k)%node)
        end associate
    end subroutine settle_link

    !> Note values and rates between two points in double precision, all of them added up but for what is known so already
    pure subroutine note_rates(chain, reach)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: reach(2)
        logical :: whole
        integer :: n, i, j

        n = size(chain%flexibility)
        whole = reach(2) - reach(1) == n
        do i = reach(1), reach(2)
            if (.not. chain%coarse(i)) call note(chain, 1 + i, chain%displacement(i), chain%displacement_rate(i))
            if (i == reach(1)) cycle
            if (.not. chain%coarse_bar(i)) call note(chain, n + 1 + i, chain%tension(i), chain%tension_rate(i))
        end do
        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            associate (l => chain%in_order(j))
                if (.not. chain%slides(l)) call note_link(chain, l)
                if (chain%slides(l) .and. whole) then
                    if (.not. abs(chain%clock - chain%since_link(l)) > 0.0_qp) call note_link(chain, l)
                end if
            end associate
        end do
    end subroutine note_rates

    !> The same for a link
    pure subroutine note_link(chain, l)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: l

        call note(chain, 2*size(chain%flexibility) + 1 + l, -chain%force(l), -chain%force_rate(l))
    end subroutine note_link

    !> Note one of them
    pure subroutine note(chain, number, value, rate)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: number
        real(qp), intent(in) :: value, rate

        chain%value(number) = real(value, wp) + 0.0_wp
        chain%rate(number) = real(rate, wp)
        chain%since(number) = real(chain%clock, wp)
    end subroutine note

    !> Note the rate of a point, and have it and its links added up
    pure subroutine note_point(chain, point, rate)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: point
        real(qp), intent(in) :: rate

        call make_fine(chain, [point, point])
        chain%displacement_rate(point) = rate
        call note(chain, 1 + point, chain%displacement(point), rate)
    end subroutine note_point

    !> Note rates of bars and of the points between them that are found in double precision
    pure subroutine note_part(chain, ends, displacement_rate, tension_rate)
        type(chain_type), intent(inout) :: chain
        !> First and last point of the bars
        integer, intent(in) :: ends(2)
        real(wp), intent(in) :: displacement_rate(:), tension_rate(:)
        integer :: i

        do i = 1, size(tension_rate)
            associate (bar => ends(1) + i)
                call note_coarse(chain, size(chain%flexibility) + 1 + bar, (chain%tension(bar)), (chain%coarse_bar(bar)), &
                                 tension_rate(i))
                chain%coarse_bar(bar) = .true.
            end associate
        end do
        do i = 1, size(displacement_rate)
            associate (point => ends(1) + i)
                call note_coarse(chain, 1 + point, (chain%displacement(point)), (chain%coarse(point)), displacement_rate(i))
                chain%coarse(point) = .true.
            end associate
        end do
    end subroutine note_part

    !> Note one of them
    pure subroutine note_coarse(chain, number, fine, coarse, rate)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: number
        !> Its value in quadruple precision, and whether it is known in double precision only
        real(qp), intent(in) :: fine
        logical, intent(in) :: coarse
        real(wp), intent(in) :: rate

        chain%value(number) = double_at(chain, number)
        if (.not. coarse) chain%value(number) = real(fine, wp) + 0.0_wp
        chain%rate(number) = rate
        chain%since(number) = real(chain%clock, wp)
    end subroutine note_coarse

    !> Go on in quadruple precision between two points, all of it added up
    pure subroutine make_fine(chain, reach)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: reach(2)
        integer :: i, j

        do i = reach(1), reach(2)
            if (chain%coarse(i)) then
                chain%displacement(i) = double_at(chain, 1 + i)
                chain%since_point(i) = chain%clock
                chain%coarse(i) = .false.
            end if
            if (i == reach(1)) cycle
            if (.not. chain%coarse_bar(i)) cycle
            chain%tension(i) = double_at(chain, size(chain%flexibility) + 1 + i)
            chain%since_bar(i) = chain%clock
            chain%coarse_bar(i) = .false.
        end do
        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            call settle_link(chain, chain%in_order(j))
            chain%slides(chain%in_order(j)) = .false.
        end do
    end subroutine make_fine

    !> One of the numbers of the chain where it is
    pure function double_at(chain, number) result(value)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: number
        real(wp) :: value

        value = chain%value(number) + (real(chain%clock, wp) - chain%since(number))*chain%rate(number)
    end function double_at

    !> Numbers of the chain where it is: displacements, forces of bars, forces of links on the beam, to the right
    pure function values_of(chain) result(values)
        type(chain_type), intent(in) :: chain
        real(wp), allocatable :: values(:)

        values = (chain%value + (real(chain%clock, wp) - chain%since)*chain%rate) + 0.0_wp
    end function values_of

end module gapbeam_axial_progress

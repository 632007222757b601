!> The chain along the beam goes on: by its rates, or to other pieces of its links.
!>
!> Where rates stay as they are, displacements and forces are added up only when they are looked at.
module gapbeam_axial_progress
    use gapbeam_kinds, only: wp, qp
    use gapbeam_unloading_quad, only: rewrite_laws
    use gapbeam_axial_chain, only: chain_type
    implicit none
    private
    public :: advance, change_pieces, settle, note_rates, values_of

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

    !> Add up what has happened between two points since they were looked at
    pure subroutine settle(chain, reach)
        type(chain_type), intent(inout) :: chain
        !> The points, and the bars and links between them
        integer, intent(in) :: reach(2)
        real(qp) :: way, limit
        integer :: i, j

        do i = reach(1), reach(2)
            way = chain%clock - chain%since_point(i)
            if (abs(way) > 0.0_qp) chain%displacement(i) = chain%displacement(i) + way*chain%displacement_rate(i)
            chain%since_point(i) = chain%clock
            if (i == reach(1)) cycle
            way = chain%clock - chain%since_bar(i)
            if (abs(way) > 0.0_qp) chain%tension(i) = chain%tension(i) + way*chain%tension_rate(i)
            chain%since_bar(i) = chain%clock
        end do
        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            associate (l => chain%in_order(j))
                way = chain%clock - chain%since_link(l)
                chain%since_link(l) = chain%clock
                if (abs(way) > 0.0_qp) then
                    chain%force(l) = chain%force(l) + way*chain%force_rate(l)
                    chain%moved(l) = chain%moved(l) + way*chain%own_rate(l)
                end if
                if (.not. chain%rubs(l)) cycle
                associate (k => chain%first(l))
                    limit = max(0.0_qp, chain%laws(k + 1)%force + way*chain%limit_rate(l))
                    chain%laws(k)%force = -limit
                    chain%laws(k + 1)%force = limit
                    chain%laws(k:k + 1)%contact = chain%displacement(chain%laws(k)%node)
                end associate
            end associate
        end do
    end subroutine settle

    !> Note values and rates between two points in double precision, all of them added up
    pure subroutine note_rates(chain, reach)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: reach(2)
        integer :: n, j

        n = size(chain%flexibility)
        associate (a => reach(1), b => reach(2))
            call note(chain, 1 + a, chain%displacement(a:b), chain%displacement_rate(a:b))
            call note(chain, n + 2 + a, chain%tension(a + 1:b), chain%tension_rate(a + 1:b))
            do j = chain%first_at(a), chain%first_at(b + 1) - 1
                associate (l => chain%in_order(j))
                    call note(chain, 2*n + 1 + l, [-chain%force(l)], [-chain%force_rate(l)])
                end associate
            end do
        end associate
    end subroutine note_rates

    !> Note some of them
    pure subroutine note(chain, first, value, rate)
        type(chain_type), intent(inout) :: chain
        !> Where they begin
        integer, intent(in) :: first
        real(qp), intent(in) :: value(:), rate(:)

        associate (last => first + size(value) - 1)
            chain%value(first:last) = real(value, wp) + 0.0_wp
            chain%rate(first:last) = real(rate, wp)
            chain%since(first:last) = real(chain%clock, wp)
        end associate
    end subroutine note

    !> Numbers of the chain where it is: displacements, forces of bars, forces of links on the beam, to the right
    pure function values_of(chain) result(values)
        type(chain_type), intent(in) :: chain
        real(wp), allocatable :: values(:)

        values = (chain%value + (real(chain%clock, wp) - chain%since)*chain%rate) + 0.0_wp
    end function values_of

end module gapbeam_axial_progress

!> Friction of supports across the beam in the chain along it: its limits, and the reactions that these are shares of.
module gapbeam_axial_friction
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type
    use gapbeam_path_tolerances, only: no_friction, same_reaction
    use gapbeam_ordered, only: sort, last_not_above
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_axial_chain, only: chain_type
    use gapbeam_history_record, only: history_type
    use gapbeam_path_states, only: solve_on_path
    implicit none
    private
    public :: set_limit, set_limits, goes_on_so, find_reactions, drop_rounding, zeros_between

contains

    !> Let friction have given limits
    pure subroutine set_limits(chain, limit)
        type(chain_type), intent(inout) :: chain
        real(qp), intent(in) :: limit(:)
        integer :: l

        do l = 1, size(limit)
            if (chain%rubs(l)) call set_limit(chain, l, limit(l))
        end do
    end subroutine set_limits

    !> The same for one link that rubs
    pure subroutine set_limit(chain, l, limit)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: l
        real(qp), intent(in) :: limit

        associate (k => chain%first(l))
            chain%laws(k)%force = -limit
            chain%laws(k + 1)%force = limit
            if (chain%closed(k) .eqv. chain%closed(k + 1)) then
                chain%force(l) = merge(limit, -limit, chain%closed(k))
            else
                chain%force(l) = max(-limit, min(limit, chain%force(l)))
            end if
        end associate
    end subroutine set_limit

    !> Does the limit of a link go on as it should, but for rounding; one that is nothing, or comes to that, is to be just that
    pure function goes_on_so(chain, l, limit, rate, way, rounding) result(it_does)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: l
        !> Limit and rate as they should be, how far, and rounding of limit and rate
        real(qp), intent(in) :: limit, rate, way
        real(wp), intent(in) :: rounding(2)
        logical :: it_does
        real(qp) :: now(2)

        now(:) = [chain%laws(chain%last(l))%force + (chain%clock - chain%since_link(l))*chain%limit_rate(l), chain%limit_rate(l)]
        it_does = all(abs(now - [limit, rate]) <= merge(rounding, 0.0_wp, limit + way*rate > rounding(1)))
    end function goes_on_so

    !> Reactions across the beam of the supports that rub, in units of the axial system
    subroutine find_reactions(beam, history, k, factor, support, rubs, reaction, error)
        !> With the loads of the leg; the path of bending, a stretch of it, and a load factor there
        type(assembled_type), intent(in), target :: beam
        type(history_type), intent(in), target :: history
        integer, intent(in) :: k
        real(wp), intent(in) :: factor
        !> Support of every link, and whether it rubs
        integer, intent(in) :: support(:)
        logical, intent(in) :: rubs(:)
        real(wp), intent(out) :: reaction(:)
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: state
        integer :: l, j

        reaction(:) = 0.0_wp
        if (at_rest()) return
        call new_state(beam, state, error)
        if (.not. allocated(error)) call solve_on_path(beam, history, k, factor, state, error)
        if (allocated(error)) return
        do l = 1, size(reaction)
            if (.not. rubs(l)) cycle
            j = beam%beam_support(support(l))
            if (j == 0) cycle
            reaction(l) = sum(state%reaction(j:last_breakpoint(beam%beam%supports, j)))
        end do
        associate (across => beam%beam%supports%node <= size(beam%beam%links))
            where (abs(reaction) <= no_friction*maxval(abs(state%reaction), across)) reaction = 0.0_wp
        end associate
        call make_ties(reaction)
        reaction(:) = scale(reaction, beam%units%force - beam%axial%units%force)

    contains

        !> A path begins at rest: there, and so near that its first events are told by rounding, nothing acts
        pure function at_rest() result(it_is)
            logical :: it_is

            associate (s => history%stretches(:history%number))
                it_is = s(k)%leg == s(1)%leg
                if (it_is) it_is = abs(factor) <= no_friction*maxval(abs(s%to), s%leg == s(1)%leg)
            end associate
        end function at_rest

    end subroutine find_reactions

    !> Reactions at one end of a stretch that are rounding beside those at the other are none: they change no sign on the way
    pure subroutine drop_rounding(at_from, at_to)
        real(wp), intent(inout) :: at_from(:), at_to(:)
        real(wp) :: least

        least = no_friction*max(maxval(abs(at_from)), maxval(abs(at_to)))
        where (abs(at_from) <= least) at_from = 0.0_wp
        where (abs(at_to) <= least) at_to = 0.0_wp
    end subroutine drop_rounding

    !> Reactions that differ by no more than rounding are the same: it must not tell which of two supports slips, and how far
    pure subroutine make_ties(reaction)
        real(wp), intent(inout) :: reaction(:)
        real(wp) :: sizes(0:size(reaction))
        integer :: l, number, low

        sizes(0) = 0.0_wp
        sizes(1:) = abs(reaction)
        call sort(sizes)
        number = 0
        do l = 1, size(reaction)
            if (sizes(l) - sizes(number) <= same_reaction*sizes(size(reaction))) cycle
            number = number + 1
            sizes(number) = sizes(l)
        end do
        do l = 1, size(reaction)
            low = last_not_above(sizes(:number), abs(reaction(l)))
            reaction(l) = sign(sizes(low), reaction(l))
        end do
    end subroutine make_ties

    !> Load factors between two at which reactions change their sign, in their order
    pure function zeros_between(from, to, at_from, at_to) result(zeros)
        real(wp), intent(in) :: from, to, at_from(:), at_to(:)
        real(qp), allocatable :: zeros(:)
        real(qp) :: zero
        integer :: l, place

        allocate (zeros(0))
        do l = 1, size(at_from)
            if (.not. (at_from(l) < 0.0_wp .and. at_to(l) > 0.0_wp .or. at_from(l) > 0.0_wp .and. at_to(l) < 0.0_wp)) cycle
            zero = from + (real(to, qp) - from)*at_from(l)/(real(at_from(l), qp) - at_to(l))
            place = count(abs(zeros - from) < abs(zero - from))
            zeros = [zeros(:place), zero, zeros(place + 1:)]
        end do
    end function zeros_between

end module gapbeam_axial_friction

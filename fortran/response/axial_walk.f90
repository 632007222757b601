!> The chain along the beam while its loads grow: from change to change of the links that act one way, yield or rub.
module gapbeam_axial_walk
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: fine_rounding
    use gapbeam_limits, only: most_idle_segments
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged, gapbeam_indeterminate
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: of_supports
    use gapbeam_polyline_quad, only: node_support_type
    use gapbeam_scene, only: gapbeam_elastic
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_axial_chain, only: chain_type, new_chain, choose_parts, next_change
    use gapbeam_axial_reach, only: find_reaches
    use gapbeam_axial_progress, only: advance, change_pieces, settle, settle_link, note_rates, values_of
    use gapbeam_axial_rates, only: moves_on, moves_at_once, not_told
    use gapbeam_axial_slip, only: find_rates_by_parts
    implicit none
    private
    public :: chain_walk_type, begin_walk, set_loads, go_to, begin_stretch, note_contacts, numbers_of

    !> Rounds in which all links of wrong sign change at once, before one alone does
    integer, parameter :: rounds_at_once = 8
    !> Share of a way below which what is left of it is rounding
    real(qp), parameter :: no_way_left = 1e-26_qp

    !> The chain on its way, and who keeps what comes of it
    type, abstract :: chain_walk_type
        type(chain_type) :: chain
        !> Support of the model of every link
        integer, allocatable :: support(:)
        !> Values at the start of the stretch at hand
        real(wp), allocatable :: start(:)
        !> Contacts of the laws there, if some keep a set, shape (size(chain%laws))
        real(wp), allocatable :: contact(:)
        !> Changes without a way between them
        integer :: idle = 0
        !> Does the chain move without end, and at which load factor; is enough kept
        logical :: lost = .false., full = .false.
        !> Does it go on from the end of go_to, where not all of it has to be added up then
        logical :: goes_on = .false.
        real(wp) :: lost_at = 0.0_wp
    contains
        procedure(keep_interface), deferred :: keep
    end type chain_walk_type

    abstract interface

        !> Keep a stretch between two load factors; its numbers at the start are in `start`, those at the end numbers_of the walk
        subroutine keep_interface(walk, assembled, from, to, error)
            import :: chain_walk_type, assembled_type, error_type, wp
            implicit none
            class(chain_walk_type), intent(inout) :: walk
            type(assembled_type), intent(in) :: assembled
            real(wp), intent(in) :: from, to
            !> No memory
            type(error_type), allocatable, intent(out) :: error
        end subroutine keep_interface

    end interface

contains

    !> Have the chain at rest
    subroutine begin_walk(assembled, walk)
        !> With links along the beam
        type(assembled_type), intent(in) :: assembled
        !> New
        class(chain_walk_type), intent(inout) :: walk
        type(node_support_type), allocatable :: laws(:)
        logical, allocatable :: rubs(:), keeps(:)
        integer :: k, l

        associate (axial => assembled%axial, given => assembled%model%supports)
            allocate (laws(size(axial%laws)), rubs(size(axial%laws)), keeps(size(axial%laws)), walk%support(size(axial%laws)))
            l = 0
            do k = 1, size(laws)
                associate (s => axial%laws(k), its => given(axial%support(k)))
                    laws(k) = node_support_type(s%node, s%side, real(s%stiffness, qp), real(s%contact, qp), s%breakpoint, s%more, &
                                                .false., real(s%force, qp), real(s%before, qp))
                    if (.not. axial%rubs(k)) laws(k)%contact = laws(k)%contact - movement_of(assembled, axial%support(k))
                    rubs(k) = axial%rubs(k)
                    keeps(k) = its%unloading /= gapbeam_elastic .and. .not. rubs(k)
                    if (s%more) cycle
                    l = l + 1
                    walk%support(l) = axial%support(k)
                end associate
            end do
            walk%support = walk%support(:l)
            call new_chain(real(axial%flexibility, qp), laws, rubs, keeps, walk%chain)
        end associate
    end subroutine begin_walk

    !> How far a support moves itself while the dead loads are put on: its settlement, and lack of fit
    pure function movement_of(assembled, support) result(movement)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: support
        real(qp) :: movement

        associate (s => assembled%model%supports(support))
            movement = scale(s%settlement + s%side*min(s%gap, 0.0_wp), -assembled%axial%units%deflection)
        end associate
    end function movement_of

    !> Rates of the loads of a leg
    subroutine set_loads(assembled, leg, way, walk)
        type(assembled_type), intent(in) :: assembled
        !> 0: dead loads, settlements and lacks of fit
        integer, intent(in) :: leg
        !> 1 where the load rises, -1 where it falls
        real(wp), intent(in) :: way
        class(chain_walk_type), intent(inout) :: walk
        integer :: case, l

        case = merge(1, 2, leg == 0)
        associate (axial => assembled%axial, chain => walk%chain, support => walk%support)
            chain%load_rate(:) = way*axial%force(case, :)
            chain%elongation_rate(:) = 0.0_qp
            if (allocated(axial%elongation)) chain%elongation_rate(:) = way*axial%elongation(case, :)
            chain%own_rate(:) = 0.0_qp
            do l = 1, size(support)
                if (chain%rubs(l)) cycle
                if (leg == 0) then
                    chain%own_rate(l) = movement_of(assembled, support(l))
                else if (allocated(assembled%growth)) then
                    chain%own_rate(l) = way*scale(assembled%growth(support(l)), -axial%units%deflection)
                end if
            end do
            chain%limit_rate(:) = 0.0_qp
        end associate
        call choose_parts(walk%chain)
    end subroutine set_loads

    !> Go from one load factor to another, limits of friction being linear between them
    subroutine go_to(walk, assembled, from, to, error, others)
        !> With the rates of the loads
        class(chain_walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        real(qp), intent(in) :: from, to
        !> Two rigid links whose forces cannot be told apart, a load factor that is not left, or no memory
        type(error_type), allocatable, intent(out) :: error
        !> Parts of the chain outside which it goes on by the rates it has, shape (2, *) (gapbeam_axial_reach); if absent, all rates
        !> are found anew
        integer, intent(in), optional :: others(:, :)
        integer, allocatable :: links(:), steps(:), reaches(:, :)
        real(qp) :: at, way
        integer :: outcome, place, single, whole(2, 1), i

        at = from
        whole(:, 1) = [0, size(walk%chain%flexibility)]
        reaches = whole
        walk%idle = 0
        if (present(others)) then
            reaches = others
        else
            walk%chain%anew = .true.
        end if
        do
            call end_if_stopped(assembled%beam%watch, error)
            if (allocated(error)) return
            call find_rates_in(walk%chain, reaches, outcome, place)
            call begin_stretch(walk, assembled)
            if (outcome == not_told) then
                call refuse_shared(assembled, walk%support(place), real(at, wp), error)
                return
            end if
            call next_change(walk%chain, outcome == moves_at_once, reaches, way, links, steps)
            ! Where a limit and what it holds vanish together, rounding is no motion
            if (outcome == moves_at_once .and. abs(to - at) <= no_way_left*abs(to - from)) return
            if (outcome == moves_at_once) then
                if (size(links) == 0) then
                    walk%lost = .true.
                    walk%lost_at = real(at, wp)
                    return
                end if
                if (way > 0.0_qp) call advance(walk%chain, way, .true.)
            else
                ! What happens at its end belongs to what follows
                if (way >= abs(to - at) - no_way_left*abs(to - from)) then
                    call go_on(to)
                    return
                end if
                if (way > 0.0_qp) call go_on(at + sign(way, to - from))
                if (allocated(error) .or. walk%full) return
            end if
            if (way > 0.0_qp) then
                walk%idle = 0
            else
                walk%idle = walk%idle + 1
            end if
            if (walk%idle > 4*size(walk%support) + most_idle_segments) then
                call fatal_error(error, gapbeam_not_converged, "along the beam the path does not leave load factor "// &
                                 trim(shown(real(at, wp)))//", where rounding hides which support slips first: bring the "// &
                                 "magnitudes of the beam nearer to each other")
                return
            end if
            single = size(links)
            if (walk%idle > rounds_at_once) single = 1
            reaches = whole
            if (outcome /= moves_at_once) reaches = find_reaches(walk%chain, links(:single))
            do i = 1, size(reaches, 2)
                call settle(walk%chain, reaches(:, i))
            end do
            do i = 1, single
                call settle_link(walk%chain, links(i))
            end do
            call change_pieces(walk%chain, links(:single), steps(:single))
        end do

    contains

        !> Go on with the load, and keep the stretch
        subroutine go_on(next)
            real(qp), intent(in) :: next
            real(wp) :: begin, end

            begin = real(at, wp)
            end = real(next, wp)
            call advance(walk%chain, abs(next - at), .false.)
            if (.not. (abs(to - next) > 0.0_qp .or. walk%goes_on)) then
                ! At the end all digits are those of quadruple precision
                call settle(walk%chain, whole(:, 1))
                call note_rates(walk%chain, whole(:, 1))
            end if
            if (abs(end - begin) > 0.0_wp) call walk%keep(assembled, begin, end, error)
            at = next
        end subroutine go_on

    end subroutine go_to

    !> Find rates in parts of the chain, and note them
    subroutine find_rates_in(chain, reaches, outcome, place)
        type(chain_type), intent(inout) :: chain
        !> First and last points, shape (2, *)
        integer, intent(in) :: reaches(:, :)
        !> As for find_rates_by_parts
        integer, intent(out) :: outcome, place
        integer :: i
        logical :: dragged

        outcome = moves_on
        do i = 1, size(reaches, 2)
            dragged = .true.
            do while (dragged)
                call find_rates_by_parts(chain, reaches(:, i), outcome, place, dragged)
                if (outcome == not_told) exit
            end do
            call note_rates(chain, reaches(:, i))
            if (outcome /= moves_on) return
        end do
    end subroutine find_rates_in

    !> Begin a stretch: the numbers of the chain, and where laws that keep a set have gone, dead movements of supports included
    pure subroutine begin_stretch(walk, assembled)
        class(chain_walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled

        walk%start = numbers_of(walk)
        call note_contacts(walk, assembled)
    end subroutine begin_stretch

    !> Note where laws that keep a set have gone
    pure subroutine note_contacts(walk, assembled)
        !> As for begin_stretch
        class(chain_walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        integer :: l

        if (.not. any(walk%chain%keeps_set)) return
        if (.not. allocated(walk%contact)) allocate (walk%contact(size(walk%chain%laws)))
        associate (chain => walk%chain)
            do l = 1, size(walk%support)
                associate (k => chain%first(l), last => chain%last(l))
                    walk%contact(k:last) = real(chain%laws(k:last)%contact + movement_of(assembled, walk%support(l)), wp)
                end associate
            end do
        end associate
    end subroutine note_contacts

    !> Numbers of the chain, of which rounding leaves nothing where it comes to rest: first displacements, then forces
    pure function numbers_of(walk) result(values)
        class(chain_walk_type), intent(in) :: walk
        real(wp), allocatable :: values(:)
        integer :: n

        allocate (values, source=values_of(walk%chain))
        if (.not. allocated(walk%start)) return
        n = size(walk%chain%flexibility) + 1
        call drop_rounding(walk%start(:n), values(:n))
        call drop_rounding(walk%start(n + 1:), values(n + 1:))

    contains

        !> Leave out what is rounding beside what there was before
        pure subroutine drop_rounding(before, values)
            real(wp), intent(in) :: before(:)
            real(wp), intent(inout) :: values(:)
            real(wp) :: least
            integer :: i

            least = 0.0_wp
            do i = 1, size(before)
                least = max(least, abs(before(i)))
            end do
            least = real(fine_rounding, wp)*least
            do i = 1, size(values)
                if (abs(values(i)) <= least) values(i) = 0.0_wp
            end do
        end subroutine drop_rounding

    end function numbers_of

    !> Refuse to tell what statics cannot
    subroutine refuse_shared(assembled, support, factor, error)
        type(assembled_type), intent(in) :: assembled
        !> One of the two
        integer, intent(in) :: support
        real(wp), intent(in) :: factor
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_indeterminate, "the support at x = "// &
                         trim(shown(point_x(assembled, assembled%support_point(support))))//" and another one hold "// &
                         "the beam rigidly along its axis with nothing between them that gives way, at load factor "// &
                         trim(shown(factor))//", so statics cannot tell what each of them takes: give the beam a finite "// &
                         "EA, or one of them a finite stiffness")
        error%table = of_supports
        error%entry = support
    end subroutine refuse_shared

end module gapbeam_axial_walk

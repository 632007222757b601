!> Margin of a zone of contact, or of a support, against a change; zero where it changes.
!>
!> A zone appears or vanishes where the greatest way of the beam past the line at which a layer acts is zero; two zones merge, or
!> one splits, where the least one between them is; an end comes to the end of a layer, or leaves it, where the way there is, or
!> its slope, where a support holds the beam. As functions of the load factor all these are continuous, with their slopes, whatever
!> the zones are on either side.
module gapbeam_zone_margin
    use gapbeam_kinds, only: wp, dp
    use gapbeam_limits, only: parts_of_stretch, most_root_steps
    use gapbeam_tolerances, only: stationary_place
    use gapbeam_foundation, only: stretch_load_type, stretch_ends_type
    use gapbeam_foundation_stretch, only: softness_in
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_curved, only: curved_type, curved_fields
    use gapbeam_law_margins, only: margin_in_scheme
    use gapbeam_ground_laws, only: distance_to_breakpoint
    use gapbeam_workspace, only: workspace_type
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_stretch_loads, only: combined_load
    use gapbeam_zone_fields, only: ends_of, take_curved
    implicit none
    private
    public :: change_type, find_margin

    !> A change that is looked for
    type :: change_type
        !> Number of the support of the engine, or else 0
        integer :: support = 0
        !> Its state before
        logical :: closed = .false.
        !> Foundation, side of its layer, and the branch of its law that makes up the zone
        integer :: foundation = 0, side = 0, branch = 0
        !> Between which distances from the left end of the beam
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        !> Does the greatest way decide, and not the least
        logical :: greatest = .true.
        !> Where a support holds the beam at the line at which the layer begins to act: does the slope there decide
        logical :: by_slope = .false.
    end type change_type

contains

    !> The margin of a change
    subroutine find_margin(ground, grounded, zones, factor, work, closed, change, margin, place)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        !> The beam on its zones, solved in work at a load factor, and the states of its supports
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        logical, intent(in) :: closed(:)
        type(change_type), intent(in) :: change
        !> Below zero before it, or after it; of a support a force on one side of zero, a distance on the other
        real(wp), intent(out) :: margin
        !> Distance from the left end of the beam at which that is decided
        real(wp), intent(out) :: place
        real(wp) :: left, begin, right, rounding, near
        integer :: i, j, k

        place = change%from
        if (change%support > 0) then
            associate (s => change%support)
                call margin_in_scheme(ground%beam%supports, closed, s, work%answers(grounded%beam%supports(s)%node) &
                                      %deflection, 0.0_wp, work%reaction, work%reaction_error, margin, rounding)
                if (closed(s) .eqv. change%closed) margin = -margin
            end associate
            return
        end if
        margin = merge(-huge(margin), huge(margin), change%greatest)
        ! The places of a change are reckoned otherwise and in double precision: what is one place differs by rounding
        near = epsilon(1.0_dp)*(2 + size(ground%pieces))*sum(ground%pieces%length)
        right = 0.0_wp
        do j = 1, size(ground%pieces)
            begin = right
            do i = grounded%node(j - 1) + 1, grounded%node(j)
                left = right
                right = left + grounded%stretches(i)%length
                if (i == grounded%node(j)) right = begin + ground%pieces(j)%length
                if (change%to < left - near .or. change%from > right + near) cycle
                do k = ground%first(j), ground%first(j + 1) - 1
                    if (ground%layers(k)%foundation /= change%foundation .or. ground%layers(k)%side /= change%side) cycle
                    call search_stretch(ground, grounded, zones, factor, work, change, i, j, k, left, begin, margin, place)
                end do
            end do
        end do
    end subroutine find_margin

    !> Look for the greatest or least way past a layer in a stretch
    subroutine search_stretch(ground, grounded, zones, factor, work, change, i, j, k, left, begin, margin, place)
        !> As for find_margin
        type(ground_type), intent(in) :: ground
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        type(change_type), intent(in) :: change
        !> Stretch, its piece, and the layer
        integer, intent(in) :: i, j, k
        !> Distances from the left end of the beam at which stretch and piece begin
        real(wp), intent(in) :: left, begin
        !> What was found so far
        real(wp), intent(inout) :: margin, place
        type(curved_type), allocatable :: curved
        type(stretch_load_type) :: load
        type(stretch_ends_type) :: ends
        real(wp) :: first, last, at, next, slope, before
        integer :: part

        call take_curved(ground, grounded, zones, factor, work, i, curved)
        load = combined_load(grounded%dead(i), grounded%live(i), factor)
        ends = ends_of(grounded, factor, work, i)
        first = min(1.0_wp, max(0.0_wp, (change%from - left)/grounded%stretches(i)%length))
        last = min(1.0_wp, max(first, (change%to - left)/grounded%stretches(i)%length))
        call evaluate_at(first, before)
        if (change%by_slope) margin = merge(-before, before, first > 0.0_wp)
        if (.not. last > first) return
        at = first
        do part = 1, parts_of_stretch
            next = first + (last - first)*part/parts_of_stretch
            call evaluate_at(next, slope)
            if (merge(before > 0.0_wp .and. slope < 0.0_wp, before < 0.0_wp .and. slope > 0.0_wp, change%greatest)) then
                call find_extreme_between(at, before, next, slope)
            end if
            at = next
            before = slope
        end do

    contains

        !> The way past the layer at a share of the stretch
        subroutine evaluate_at(share, slope)
            real(wp), intent(in) :: share
            !> Of the way
            real(wp), intent(out) :: slope
            real(wp) :: w, psi, moment, shear, way, soft(2)

            associate (s => grounded%stretches(i))
                if (allocated(curved)) then
                    call curved_fields(curved, share, w, psi, moment, shear)
                else
                    call fields_at(s, load, ends, share, w, psi, moment, shear)
                end if
                soft(:) = softness_in(s, share)
                call distance_to_breakpoint(ground%laws, ground%layers(k), change%branch, w, psi + soft(2)*shear, &
                                            (left - begin) + share*s%length, ground%pieces(j)%length, way, slope)
                if (merge(way > margin, way < margin, change%greatest)) then
                    margin = way
                    place = left + share*s%length
                end if
            end associate
        end subroutine evaluate_at

        !> Where the slope vanishes between two shares, by secants and halves
        subroutine find_extreme_between(from, at_from, to, at_to)
            real(wp), intent(in) :: from, at_from, to, at_to
            real(wp) :: low, high, f_low, f_high, share, slope
            integer :: step

            low = from
            high = to
            f_low = at_from
            f_high = at_to
            do step = 1, most_root_steps
                share = low + (high - low)*merge(0.5_wp, f_low/(f_low - f_high), mod(step, 3) == 0)
                call evaluate_at(share, slope)
                if (min(share - low, high - share) <= stationary_place .or. .not. abs(slope) > 0.0_wp) return
                if (slope > 0.0_wp .eqv. f_low > 0.0_wp) then
                    low = share
                    f_low = slope
                else
                    high = share
                    f_high = slope
                end if
            end do
        end subroutine find_extreme_between

    end subroutine search_stretch

end module gapbeam_zone_margin

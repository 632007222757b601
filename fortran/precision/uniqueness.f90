!> Whether a beam on the ground has one state for sure, and whether two of its states are one branch.
!>
!> Its energy is convex where the beam is stable on the least slopes that its supports and its ground may have: with all one-sided
!> supports open and off all one-sided ground everywhere, or, from one state to another, between the two. Displacements whose
!> places on all laws are between those of two states are a convex set, on which the energy under any loads has one least point
!> at most; it moves with the loads without a jump.
module gapbeam_uniqueness
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_mode_stretches
    use gapbeam_law, only: node_support_type, always_closed
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_law_energy, only: is_convex
    use gapbeam_piece, only: piece_type, is_compressed
    use gapbeam_layers, only: layer_type, law_piece_type, law_piece, has_curves, has_points, pieces_of_law
    use gapbeam_ground_steps, only: greatest_modulus
    use gapbeam_filled_ground, only: any_falls
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, full_contact, new_zones, resize
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_modes, only: by_axial_force, by_vibration, count_modes
    implicit none
    private
    public :: is_unique, is_one_branch, compression_lengths, weakest_piece

    !> Modulus of a bed, as a share of the greatest slope of the ground, that takes nothing from a beam and holds one that nothing
    !> holds; tuned
    real(wp), parameter :: soft_bed = 2.0_wp**(-36)

contains

    !> Length of a piece beside the one by which the phase of a wave under its compression grows by 1
    elemental function compression_lengths(piece) result(number)
        type(piece_type), intent(in) :: piece
        real(wp) :: number

        number = piece%length*sqrt(piece%compression)*sqrt(piece%flexibility)
    end function compression_lengths

    !> Is there one state for sure: without compression and falling forces, or where the beam is stable on what holds it both ways
    !> alone, and on ground that falls everywhere
    function is_unique(ground) result(unique)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        logical :: unique
        type(zones_type) :: zones
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        logical :: acting(size(ground%beam%supports))
        integer :: i, k, number

        unique = .not. (any(is_compressed(ground%pieces)) .or. any_falls(ground))
        if (unique .or. sum(compression_lengths(ground%pieces)) > most_mode_stretches) return
        if (.not. is_convex(ground%beam%supports)) return
        if (any(has_curves(ground%layers))) return
        call full_contact(ground, zones)
        do i = 1, size(zones%piece)
            associate (first => ground%first(zones%piece(i)))
                do k = first, ground%first(zones%piece(i) + 1) - 1
                    associate (layer => ground%layers(k))
                        if (layer%side /= 0) zones%acts(k - first + 1, i) = &
                            weakest_piece(layer, ground%laws, 0, pieces_of_law(layer))
                    end associate
                end do
            end associate
        end do
        acting(:) = .true.
        acting(:) = weakest_scheme(ground%beam%supports, always_closed(ground%beam%supports), acting)
        call count_modes(ground, zones, acting, by_axial_force, 1.0_wp, number, work, grounded)
        unique = number == 0
    end function is_unique

    !> Which supports act where they hold least between two schemes: those that act in both, and of every law its flattest piece
    pure function weakest_scheme(supports, one, other) result(acting)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: one(:), other(:)
        logical :: acting(size(supports))
        real(wp) :: slope, least
        integer :: first, last, piece, k

        acting(:) = one .and. other
        first = 1
        do while (first <= size(supports))
            last = first
            if (supports(first)%breakpoint > 0) then
                last = last_breakpoint(supports, first)
                associate (a => count(one(first:last)), b => count(other(first:last)))
                    piece = a
                    least = huge(least)
                    do k = min(a, b), max(a, b)
                        slope = supports(first)%before
                        if (k > 0) slope = supports(first + k - 1)%stiffness
                        if (.not. slope < least) cycle
                        least = slope
                        piece = k
                    end do
                end associate
                acting(first:last) = [(k <= piece, k=1, last - first + 1)]
            end if
            first = last + 1
        end do
    end function weakest_scheme

    !> Has a layer its least slope on a piece of its law, 0: not in contact, among those from one to another
    pure function weakest_piece(layer, laws, from, to) result(number)
        type(layer_type), intent(in) :: layer
        !> Pieces of all laws
        type(law_piece_type), intent(in) :: laws(:)
        integer, intent(in) :: from, to
        integer :: number
        real(wp) :: slope, least
        integer :: k

        number = to
        if (from == 0) number = 0
        if (.not. has_points(layer) .or. layer%law_last < layer%law_first) return
        least = huge(least)
        if (from == 0) least = 0.0_wp
        do k = max(1, from), to
            associate (piece => law_piece(layer, laws, k))
                slope = min(piece%slope_a, piece%slope_b)
            end associate
            if (.not. slope < least) cycle
            least = slope
            number = k
        end do
    end function weakest_piece

    !> Are two states on one branch for sure: is the energy convex between them
    function is_one_branch(ground, one, other, factor) result(it_is)
        !> The beam and its ground, whose forces fall and whose supports do not
        type(ground_type), intent(in) :: ground
        !> The two states
        type(ground_start_type), intent(in) :: one, other
        !> Load factor, under which curves have their slopes
        real(wp), intent(in) :: factor
        logical :: it_is
        type(ground_type) :: bedded
        logical :: acting(size(one%closed))
        integer :: k

        ! A beam that nothing holds on the way is moved without a jump as well: a bed that is next to nothing holds it, as a mass
        ! below zero would
        bedded = ground
        bedded%pieces%mass = soft_bed*maxval([0.0_wp, (greatest_modulus(ground%layers(k), ground%laws), k=1, size(ground%layers))])
        if (allocated(bedded%mass)) deallocate (bedded%mass)
        ! A support that lets go on the way counts as open
        acting(:) = weakest_scheme(ground%beam%supports, one%closed, other%closed)
        it_is = is_stable(one, other)
        if (it_is .and. any(has_curves(ground%layers))) it_is = is_stable(other, one)

    contains

        !> Is the beam stable on the weakest ground between the two, whose curves are as in the first of them
        function is_stable(first, second) result(stable)
            type(ground_start_type), intent(in) :: first, second
            logical :: stable
            type(zones_type) :: zones
            type(grounded_type) :: grounded
            type(workspace_type) :: work
            integer :: number

            call weakest_between(ground, first%zones, second%zones, zones)
            call count_modes(bedded, zones, acting, by_vibration, -1.0_wp, number, work, grounded, factor=factor)
            stable = number == 0
        end function is_stable

    end function is_one_branch

    !> Stretches in which two states stay on one piece of every law each, and of the pieces between these those that are weakest
    pure subroutine weakest_between(ground, one, other, zones)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: one, other
        !> With the fields of the first
        type(zones_type), intent(out) :: zones
        integer :: i, j, k, m
        real(wp) :: from, to, share

        call new_zones(size(one%piece) + size(other%piece), size(one%acts, 1), one%steps, zones)
        m = 0
        i = 1
        j = 1
        do while (i <= size(one%piece) .and. j <= size(other%piece))
            from = max(one%from(i), other%from(j))
            to = min(one%to(i), other%to(j))
            if (to > from) then
                m = m + 1
                zones%piece(m) = one%piece(i)
                zones%from(m) = from
                zones%to(m) = to
                associate (first => ground%first(one%piece(i)), next => one%start(:, min(i + 1, size(one%piece))))
                    zones%acts(:, m) = 0
                    do k = 1, ground%first(one%piece(i) + 1) - first
                        associate (a => one%acts(k, i), b => other%acts(k, j))
                            zones%acts(k, m) = weakest_piece(ground%layers(first + k - 1), ground%laws, min(a, b), max(a, b))
                        end associate
                    end do
                    share = (from - one%from(i))/(one%to(i) - one%from(i))
                    zones%start(:, m) = one%start(:, i) + share*(next - one%start(:, i))
                end associate
            end if
            associate (end_of_one => one%to(i), end_of_other => other%to(j))
                if (end_of_one <= end_of_other) i = i + 1
                if (end_of_other <= end_of_one) j = j + 1
            end associate
        end do
        call resize(zones, m, m)
    end subroutine weakest_between

end module gapbeam_uniqueness

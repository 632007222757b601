!> Loads along a beam on springs and sliders, and the way from some to others, over which sliders go one way.
module gapbeam_bedding_loads
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: before_all_slides
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_bedding, only: bedding_type, loads_type, no_limit
    use gapbeam_bedding_zones, only: find_zones, turns_back
    implicit none
    private
    public :: loads_at, go_to_loads, follow_loads

    !> Places between loads at which it is looked whether all that slides goes on
    integer, parameter :: looks = 16

contains

    !> Loads along a beam at a load factor
    pure function loads_at(assembled, factor, is_dead) result(loads)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: factor
        !> Does it put on the dead loads
        logical, intent(in) :: is_dead
        type(loads_type) :: loads
        real(qp) :: by_case(2)
        integer :: n

        by_case(:) = merge([real(factor, qp), 0.0_qp], [1.0_qp, real(factor, qp)], is_dead)
        associate (axial => assembled%axial)
            n = size(axial%softness)
            allocate (loads%node(0:n), source=matmul(by_case, real(axial%force, qp)))
            allocate (loads%along(n), loads%longer(n), source=0.0_qp)
            if (allocated(axial%elongation)) loads%longer(:) = matmul(by_case, real(axial%elongation, qp))
            if (.not. allocated(axial%along_bar)) return
            loads%along(:) = matmul(by_case, real(axial%along_bar, qp))
            ! Of these the nodes have half at either end
            loads%node(:n - 1) = loads%node(:n - 1) - loads%along/2
            loads%node(1:) = loads%node(1:) - loads%along/2
        end associate
    end function loads_at

    !> Go from loads to others, and look whether all that slides goes on all the way
    subroutine follow_loads(assembled, factors, from, to, bedding, reached, error)
        !> Whose watch it is
        type(assembled_type), intent(in) :: assembled
        !> Load factors at both ends
        real(wp), intent(in) :: factors(2)
        type(loads_type), intent(in) :: from, to
        !> Where the load turned in, where it is then out
        type(bedding_type), intent(inout) :: bedding
        !> Load factor where all of it slides; that at the end if it does not
        real(wp), intent(out) :: reached
        !> Ground that slid begins to hold on the way, or no state is found
        type(error_type), allocatable, intent(out) :: error
        type(bedding_type) :: start
        real(qp) :: share
        integer :: i
        logical :: settled

        share = min(1.0_qp, all_slides(bedding, from, to))
        reached = factors(2)
        if (share < 1.0_qp) reached = factor_of(looks)
        ! Pushes are linear in the loads until something slides: where nothing does at the end, nothing did before
        start = bedding
        call go_to_loads(bedding, from, to, share, settled)
        if (settled) then
            if (all(bedding%cells%way == 0)) return
        end if
        bedding = start
        do i = 1, looks
            call end_if_stopped(assembled%beam%watch, error)
            if (allocated(error)) return
            call go_to_loads(bedding, from, to, share*i/looks, settled)
            if (.not. settled) then
                call fatal_error(error, gapbeam_not_converged, "along the beam no state is found near load factor "// &
                                 trim(shown(factor_of(i)))//", where rounding hides what slides over the ground: bring the "// &
                                 "magnitudes of the beam nearer to each other")
                return
            end if
            if (.not. turns_back(bedding, less(to, from))) cycle
            call fatal_error(error, gapbeam_not_converged, "along the beam ground that slides begins to hold again before "// &
                             "load factor "//trim(shown(factor_of(i)))//", while the load goes on, which is not available in "// &
                             "this version where that ground has a stiffness: leave the stiffness out, or put the loads on "// &
                             "one after the other, in a history")
            return
        end do

    contains

        !> The load factor at a look
        pure function factor_of(i) result(factor)
            integer, intent(in) :: i
            real(wp) :: factor

            factor = real(factors(1) + (share*i/looks)*(real(factors(2), qp) - factors(1)), wp)
        end function factor_of

    end subroutine follow_loads

    !> Find the state at a share of the way between loads
    pure subroutine go_to_loads(bedding, from, to, share, settled)
        !> As where the load turned last, or on the way
        type(bedding_type), intent(inout) :: bedding
        type(loads_type), intent(in) :: from, to
        real(qp), intent(in) :: share
        logical, intent(out) :: settled
        type(loads_type) :: loads
        real(qp) :: gone

        gone = min(share, all_slides(bedding, from, to)*(1 - before_all_slides))
        loads = from
        loads%node(:) = loads%node + gone*(to%node - from%node)
        loads%along(:) = loads%along + gone*(to%along - from%along)
        loads%longer(:) = loads%longer + gone*(to%longer - from%longer)
        call find_zones(bedding, loads, settled)
    end subroutine go_to_loads

    !> At which share of the way between loads all of a beam slides that no support holds: they are all that its ground takes
    pure function all_slides(bedding, from, to) result(share)
        type(bedding_type), intent(in) :: bedding
        type(loads_type), intent(in) :: from, to
        real(qp) :: share, most, before, after

        share = huge(share)
        if (any(bedding%support > 0.0_wp) .or. any(bedding%limit >= no_limit)) return
        most = sum(bedding%limit)/2
        before = sum(from%node) + sum(from%along)
        after = sum(to%node) + sum(to%along)
        if (abs(after) < most .or. .not. abs(after - before) > 0.0_qp) return
        share = (sign(most, after) - before)/(after - before)
    end function all_slides

    !> Difference of loads
    pure function less(a, b) result(loads)
        type(loads_type), intent(in) :: a, b
        type(loads_type) :: loads

        loads = a
        loads%node(:) = a%node - b%node
        loads%along(:) = a%along - b%along
        loads%longer(:) = a%longer - b%longer
    end function less

end module gapbeam_bedding_loads

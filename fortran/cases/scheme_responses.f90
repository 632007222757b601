!> Responses of a beam in a scheme to each of its loads, where it is linear in them then.
!> That is so of beams with an axial force that is the same in all cases, and on ground that holds both ways: a case is a sum of
!> responses. These are found in quadruple precision, so that a sum has the digits of a case solved alone.
module gapbeam_scheme_responses
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type
    use gapbeam_tolerances, only: sign_width
    use gapbeam_limits, only: most_cancelled
    use gapbeam_scene, only: gapbeam_axial_force, gapbeam_axial_distributed, gapbeam_temperature
    use gapbeam_units, only: moment_unit
    use gapbeam_band, only: band_ok
    use gapbeam_law, only: both
    use gapbeam_model, only: has_other_supports
    use gapbeam_layers, only: branches_of_law, has_curves
    use gapbeam_ground, only: ground_type
    use gapbeam_refined_ground, only: refine_ground
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type, &
        fine_grounded_type => grounded_type, full_contact, place_stretches
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type, new_workspace, set_loads
    use gapbeam_system_quad, only: solve_scheme
    use gapbeam_law_margins_quad, only: find_margins
    use gapbeam_uniqueness, only: is_unique
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_combinations, only: combination_type, combine
    implicit none
    private
    public :: response_type, is_linear_in_schemes, changes_axial_force, find_responses, add_up, agrees

    !> Responses in a scheme, in the scene's units. Numbers of a case, one after the other: deflections, moments left and right of
    !> the nodes, reactions and margins (gapbeam_law_margins) of the supports
    type :: response_type
        logical, allocatable :: closed(:)
        !> How many cases alone have found the scheme
        integer :: times = 0
        !> Of no load but those that change the axial force, then of each other load, shape (numbers, 0:nload); not allocated where
        !> there are none yet
        real(wp), allocatable :: values(:, :)
        !> Has the scheme no responses that give the digits of a case solved alone
        logical :: is_useless = .false.
    end type response_type

contains

    !> Are the cases of a beam sums of responses, each in the only state that it has
    function is_linear_in_schemes(assembled, factors) result(it_is)
        type(assembled_type), intent(in) :: assembled
        !> Of the loads, among which those count that change the axial force
        real(wp), intent(in) :: factors(:)
        logical :: it_is
        type(combination_type) :: combined
        type(error_type), allocatable :: error

        it_is = allocated(assembled%layers) .and. .not. has_other_supports(assembled%beam) &
            .and. .not. (allocated(assembled%given_settlement) .or. assembled%model%stretching &
                       .or. allocated(assembled%axial%limit))
        if (.not. it_is) return
        associate (layers => assembled%layers)
            it_is = all(layers%side == both) .and. all(branches_of_law(layers) == 0) .and. .not. any(layers%rigid) &
                .and. .not. any(has_curves(layers))
        end associate
        if (.not. it_is) return
        call combine(assembled, factors, 0*assembled%model%supports%settlement, combined, error)
        it_is = .not. allocated(error)
        if (it_is) it_is = is_unique(ground_of(combined%assembled, 1.0_wp))
    end function is_linear_in_schemes

    !> Which loads change an axial force that bending feels
    pure function changes_axial_force(assembled) result(they_do)
        type(assembled_type), intent(in) :: assembled
        logical :: they_do(size(assembled%model%loads))
        integer :: i

        associate (loads => assembled%model%loads)
            they_do = [(assembled%model%axial_loads_bend .and. any(loads(i)%kind == [gapbeam_axial_force, &
                                                                                     gapbeam_axial_distributed, &
                                                                                     gapbeam_temperature]), i=1, size(loads))]
        end associate
    end function changes_axial_force

    !> Find the responses in a scheme
    subroutine find_responses(assembled, factors, response)
        type(assembled_type), intent(in) :: assembled
        !> Factors of the loads; those that change the axial force are in all responses
        real(wp), intent(in) :: factors(:)
        !> With its scheme in
        type(response_type), intent(inout) :: response
        type(combination_type) :: combined
        type(error_type), allocatable :: error
        real(qp), allocatable :: rest(:), found(:)
        logical :: axial(size(factors)), solved
        integer :: n, m, j, k, stat

        response%is_useless = .true.
        n = size(assembled%beam%links) + 1
        m = size(response%closed)
        allocate (rest(3*n + 2*m), found(3*n + 2*m), response%values(3*n + 2*m, 0:size(factors)), stat=stat)
        if (stat /= 0) return
        axial = changes_axial_force(assembled)
        do j = 0, size(factors)
            call combine(assembled, merge(factors, merge(1.0_wp, 0.0_wp, [(k == j, k=1, size(factors))]), axial), &
                         0*assembled%model%supports%settlement, combined, error)
            solved = .not. allocated(error)
            if (solved) call numbers_of_scheme(combined%assembled, response%closed, found, solved)
            if (.not. solved) return
            if (j == 0) rest(:) = found
            if (j > 0) found(:) = found - rest
            response%values(:, j) = real(found, wp)
        end do
        response%is_useless = .not. all(abs(response%values) <= huge(1.0_wp))
    end subroutine find_responses

    !> The numbers of a beam under its loads in a given scheme
    subroutine numbers_of_scheme(assembled, closed, found, solved)
        type(assembled_type), intent(in) :: assembled
        logical, intent(in) :: closed(:)
        real(qp), intent(out) :: found(:)
        logical, intent(out) :: solved
        type(ground_type) :: ground
        type(fine_ground_type) :: fine
        type(fine_zones_type) :: zones
        type(fine_grounded_type) :: grounded
        type(fine_workspace_type) :: work
        real(qp) :: margin(size(closed)), rounding(size(closed))
        integer :: n, m, state, place

        ground = ground_of(assembled, 1.0_wp)
        call refine_ground(ground, fine)
        call full_contact(fine, zones)
        call place_stretches(fine, zones, 1.0_qp, grounded)
        call new_workspace(grounded%beam, work)
        call set_loads(grounded%beam, 1.0_qp, work)
        call solve_scheme(grounded%beam, closed, work, state, place)
        solved = state == band_ok
        if (.not. solved) return
        n = size(assembled%beam%links) + 1
        m = size(closed)
        call find_margins(grounded%beam%supports, closed, work%answers, work%deflection_size, work%reaction, work%reaction_error, &
                          margin, rounding)
        associate (a => work%answers(grounded%node), units => assembled%units)
            found(:n) = scale(a%deflection, units%deflection)
            found(n + 1:2*n) = scale(a%moment_left, moment_unit(units))
            found(2*n + 1:3*n) = scale(a%moment_right, moment_unit(units))
            found(3*n + 1:3*n + m) = scale(work%reaction(:m), units%force)
            found(3*n + m + 1:) = scale(margin, merge(units%force, units%deflection, closed))
        end associate
    end subroutine numbers_of_scheme

    !> The numbers of a case in a scheme
    pure subroutine add_up(response, factors, watched, nodes, values, is_sound, wrong)
        !> With its values
        type(response_type), intent(in) :: response
        !> Factors of the loads; of those that change the axial force as they were when the responses were found
        real(wp), intent(in) :: factors(:)
        !> Which supports have more than one state
        logical, intent(in) :: watched(:)
        integer, intent(in) :: nodes
        !> The numbers
        real(wp), intent(out) :: values(:)
        !> Have they all their digits, and do the signs of the supports tell which are wrong
        logical, intent(out) :: is_sound, wrong(:)
        real(wp) :: sizes(size(values)), term
        integer :: i, j, m

        m = size(watched)
        values(:) = response%values(:, 0)
        sizes(:) = abs(values)
        do j = 1, size(factors)
            if (.not. abs(factors(j)) > 0.0_wp) cycle
            do i = 1, size(values)
                term = factors(j)*response%values(i, j)
                values(i) = values(i) + term
                sizes(i) = sizes(i) + abs(term)
            end do
        end do
        associate (margin => values(3*nodes + m + 1:), size_of => sizes(3*nodes + m + 1:))
            wrong(:) = watched .and. margin < 0.0_wp
            is_sound = .not. any(watched .and. abs(margin) <= sign_width*epsilon(1.0_wp)*size_of)
        end associate
        is_sound = is_sound .and. keeps_digits(values(:nodes), sizes(:nodes)) &
            .and. keeps_digits(values(nodes + 1:3*nodes), sizes(nodes + 1:3*nodes)) &
            .and. keeps_digits(values(3*nodes + 1:3*nodes + m), sizes(3*nodes + 1:3*nodes + m))
    end subroutine add_up

    !> Are sums not far less than their terms, and within range
    pure function keeps_digits(values, sizes) result(it_does)
        real(wp), intent(in) :: values(:), sizes(:)
        logical :: it_does

        it_does = .true.
        if (size(values) == 0) return
        it_does = maxval(sizes) <= min(most_cancelled*maxval(abs(values)), huge(1.0_wp))
    end function keeps_digits

    !> Are the numbers of a case those of it solved alone, but for rounding
    pure function agrees(values, alone, nodes) result(they_do)
        !> By add_up, and deflections, moments and reactions of the case solved alone
        real(wp), intent(in) :: values(:), alone(:)
        integer, intent(in) :: nodes
        logical :: they_do

        they_do = same(1, nodes) .and. same(nodes + 1, 3*nodes) .and. same(3*nodes + 1, size(alone))

    contains

        !> Some of the numbers, beside the largest of them
        pure function same(first, last)
            integer, intent(in) :: first, last
            logical :: same

            same = .true.
            if (last < first) return
            same = maxval(abs(values(first:last) - alone(first:last))) &
                <= sign_width*epsilon(1.0_wp)*most_cancelled*maxval(abs(alone(first:last)))
        end function same

    end function agrees

end module gapbeam_scheme_responses

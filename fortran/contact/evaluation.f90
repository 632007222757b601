!> Evaluation of a contact state: its solution, and the supports that are wrong in it.
!>
!> Where signs are clear deflections and moments are enough. Otherwise reactions are found, and where few supports are wrong the
!> solution is refined; on a long beam that is not solved from both ends it is kept up to date from then on.
module gapbeam_evaluation
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: few_wrong_supports, long_beam_links
    use gapbeam_tolerances, only: sign_width
    use gapbeam_watch, only: is_stopped
    use gapbeam_band, only: band_ok, band_stopped
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_system, only: solve_deflections, complete_scheme, refine_scheme
    use gapbeam_update, only: keep_factor, update_scheme, find_groups
    use gapbeam_signs, only: sign_type, prepare_signs, find_clearly_wrong
    use gapbeam_reactions, only: by_stretches
    use gapbeam_rules, only: find_wrong
    use gapbeam_contact_boundary, only: base_type
    implicit none
    private
    public :: search_type, evaluate_active_set

    !> A search on its way
    type :: search_type
        !> Which are wrong in the scheme solved last, how many, and the least number so far
        logical, allocatable :: wrong(:)
        integer :: wrong_now = 0, fewest = 0
        !> The scheme in which that was so
        logical, allocatable :: best(:)
        !> Has any support a law; do laws go on by one piece at a time
        logical :: with_laws = .false., by_pieces = .false.
        !> Is everything refined where few are wrong
        logical :: carefully = .false.
        !> Is this a subdomain of the beam, so that what is found is looked at again in the whole
        logical :: in_subdomain = .false.
        !> Rounding errors beyond which a sign counts
        real(wp) :: width = sign_width
        !> The scheme solved last, if its solution can be kept up to date; that which nodes in work are those of, if they are of any
        logical, allocatable :: kept(:), applied(:)
        !> The supports whose signs count
        type(sign_type) :: signs
        !> Supports by nodes, for boundaries of contact
        type(base_type) :: base
        !> Rounds of subdomains that are left, and the nodes that go with a subdomain in the next one
        integer :: rounds = 0, next_rounds = 0, margin = 0
        !> How the last solve went, and where not well
        integer :: state = 0, place = 0
    end type search_type

contains

    !> Solve a contact state, and find what is wrong in it
    subroutine evaluate_active_set(beam, closed, reactions, work, search, settled)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Are reactions needed, and not only what is wrong; a few wrong supports always have them
        logical, intent(in) :: reactions
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        logical, intent(out) :: settled
        logical :: doubtful, follows

        settled = .false.
        if (allocated(search%kept)) then
            call evaluate_changes(beam, closed, work, search)
            if (allocated(search%applied)) deallocate (search%applied)
            if (allocated(search%kept)) then
                settled = search%wrong_now == 0 .and. search%state == band_ok
                return
            end if
        end if
        if (allocated(search%applied)) then
            call solve_deflections(beam, closed, work, search%state, search%place, search%applied)
        else
            call solve_deflections(beam, closed, work, search%state, search%place)
            allocate (search%applied(size(closed)))
        end if
        search%applied(:) = closed
        if (search%state /= band_ok) return
        if (.not. (reactions .or. allocated(beam%ground))) then
            if (.not. allocated(search%signs%w)) call prepare_signs(beam, work, search%signs)
            call find_clearly_wrong(beam, search%signs, closed, work, search%wrong, search%wrong_now, doubtful)
            if (.not. doubtful .and. (search%wrong_now > few_wrong_supports .or. (work%from_both_ends .or. search%in_subdomain) &
                                     .and. .not. search%carefully)) then
                settled = search%wrong_now == 0
                return
            end if
        end if
        call complete_scheme(beam, closed, work)
        call find_wrong(beam, closed, search%width, work, search%wrong)
        search%wrong_now = count(search%wrong)
        if (search%wrong_now <= few_wrong_supports .and. (search%wrong_now > 0 .or. (search%carefully .and. by_stretches))) then
            ! Near the end signs depend on the last digits
            call refine_scheme(beam, closed, work)
            call find_wrong(beam, closed, search%width, work, search%wrong)
            search%wrong_now = count(search%wrong)
            if (size(beam%links) >= long_beam_links .and. .not. (allocated(beam%ground) .or. work%from_both_ends) &
                .and. search%wrong_now > 0 .and. search%wrong_now <= few_wrong_supports) then
                ! And little changes any more
                call keep_factor(beam, work, follows)
                if (follows) allocate (search%kept, source=closed)
            end if
        end if
        settled = search%wrong_now == 0
    end subroutine evaluate_active_set

    !> The same where few supports have changed since the last solve; nothing is kept any more where that does not do
    subroutine evaluate_changes(beam, closed, work, search)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        integer :: changed(few_wrong_supports), groups(2, few_wrong_supports), number, parts, k, j, window(2), state

        if (is_stopped(beam%watch)) then
            search%state = band_stopped
            return
        end if
        number = 0
        do k = 1, size(closed)
            if (closed(k) .eqv. search%kept(k)) cycle
            if (number == few_wrong_supports) then
                deallocate (search%kept)
                return
            end if
            number = number + 1
            changed(number) = k
        end do
        work%refined = .false.
        call find_groups(beam, changed(:number), groups(:, :number), parts)
        do j = 1, parts
            call update_scheme(beam, closed, groups(:, j), .false., work, window, state)
            if (state /= band_ok) then
                deallocate (search%kept)
                return
            end if
        end do
        work%solves = work%solves + 1
        search%kept(:) = closed
        search%state = band_ok
        call find_wrong(beam, closed, search%width, work, search%wrong)
        search%wrong_now = count(search%wrong)
    end subroutine evaluate_changes

end module gapbeam_evaluation

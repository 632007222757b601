!> Refusals of supports along the beam, of friction, and of supports that hold rotations, that make no sense or are not there in
!> this version.
module gapbeam_check_axial
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_words, only: shown
    use gapbeam_laws, only: is_smooth
    use gapbeam_scene, only: model_type, law_point_type, gapbeam_both, gapbeam_axial, gapbeam_normal, gapbeam_broken, &
        ground_law_point_type
    use gapbeam_assembled_model, only: turns
    use gapbeam_axial_force, only: in_stretches, what_stretches
    use gapbeam_input_error, only: refuse, of_supports, bad_law
    implicit none
    private
    public :: check_along

contains

    !> Refuse what is not there yet, or makes no sense
    subroutine check_along(model, law, with_law, error)
        type(model_type), intent(in) :: model
        !> Points of all laws
        type(law_point_type), intent(in) :: law(:)
        !> Which supports have a law
        logical, intent(in) :: with_law(:)
        type(error_type), allocatable, intent(out) :: error
        character(len=*), parameter :: in_version = " is not available in this version", &
            beside_curve = " beside a support whose law is a curve"//in_version//"; give the points of the curve"
        character(len=:), allocatable :: which, where
        logical, allocatable :: falls(:)
        logical :: curved, stiff
        integer :: k, stat

        call find_falling(law, size(model%supports), falls, stat)
        if (failed(stat, error)) return
        curved = any(is_smooth(model%supports%law))
        stiff = any(model%spans%EI > huge(1.0_wp)) .or. any(model%sections%EI > huge(1.0_wp))
        do k = 1, size(model%supports)
            associate (s => model%supports(k))
                which = "along the beam"
                where = which
                if (turns(s)) which = "that holds a rotation"
                if (turns(s)) where = "over a rotation"
                if (s%direction == gapbeam_normal .and. is_smooth(s%law) .and. any(falls_there(model%ground_law))) then
                    call say("law", "a curve beside a foundation whose force falls"//in_version//"; give its points")
                else if (.not. (s%friction >= 0.0_wp .and. s%friction <= huge(1.0_wp))) then
                    call say("friction", "expected a finite number, 0 or more, got "//trim(shown(s%friction)))
                else if (s%direction == gapbeam_normal) then
                    if (s%friction > 0.0_wp) call check_rest("friction", "friction")
                else if (s%friction > 0.0_wp) then
                    call say("friction", "a support "//which//" has none; give it to one across the beam")
                else if (with_law(k) .and. is_smooth(s%law)) then
                    call say("law", "a curve "//where//in_version//"; give its points")
                else if (s%unloading == gapbeam_broken) then
                    call say("unloading", "that a support "//which//" breaks"//in_version//"; give plastic or elastic")
                else if (with_law(k) .and. falls(k)) then
                    call say("law", "a force that falls "//where//in_version//"; give a law that rises or stays")
                else if (turns(s)) then
                    if (curved) then
                        call say("direction", "a support that holds a rotation by a law, a slack, one way or at a hinge"// &
                                 beside_curve)
                    else if (stiff) then
                        call say("direction", "beside a rigid beam (infinite EI) it"//in_version//"; give EI")
                    end if
                else if (with_law(k)) then
                    call check_rest("law", "an axial support with a law")
                else if (s%side /= gapbeam_both) then
                    call check_rest("side", "an axial support that pushes one way only")
                end if
            end associate
            if (allocated(error)) return
        end do

    contains

        !> What is wrong
        subroutine say(key, problem)
            character(len=*), intent(in) :: key, problem

            call refuse(error, of_supports, k, size(model%supports), bad_law, key, problem)
        end subroutine say

        !> What else there is in the model
        subroutine check_rest(key, what)
            character(len=*), intent(in) :: key, what

            ! Bending feels the chain as it is found alone
            if (model%axial_loads_bend) return
            if (in_stretches(model)) then
                call say(key, what//" beside "//trim(what_stretches(model))//in_version//"; leave one of them out")
            else if (curved) then
                call say(key, what//beside_curve)
            end if
        end subroutine check_rest

    end subroutine check_along

    !> Is the force of ground less at a point of its law than at the one before
    pure function falls_there(points) result(it_does)
        type(ground_law_point_type), intent(in) :: points(:)
        logical :: it_does(size(points))
        integer :: i

        it_does(:) = .false.
        do i = 2, size(points)
            associate (before => points(i - 1), p => points(i))
                it_does(i) = p%foundation == before%foundation .and. p%force < before%force .and. .not. abs(p%x - before%x) > 0.0_wp
            end associate
        end do
    end function falls_there

    !> Does the force of a law fall anywhere
    pure subroutine find_falling(law, number, falls, stat)
        type(law_point_type), intent(in) :: law(:)
        !> Number of supports
        integer, intent(in) :: number
        !> Of every support
        logical, allocatable, intent(out) :: falls(:)
        !> Not 0 where there is no memory
        integer, intent(out) :: stat
        real(wp), allocatable :: before(:)
        integer :: i

        allocate (falls(number), before(number), stat=stat)
        if (stat /= 0) return
        falls(:) = .false.
        before(:) = 0.0_wp
        do i = 1, size(law)
            associate (k => law(i)%support)
                falls(k) = falls(k) .or. law(i)%force < before(k)
                before(k) = law(i)%force
            end associate
        end do
    end subroutine find_falling

end module gapbeam_check_axial

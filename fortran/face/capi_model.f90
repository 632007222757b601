!> The model of the C interface, pointers to plain arrays, as the library's own
module gapbeam_capi_model
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_signed_char, c_intptr_t, c_ptr, c_null_ptr, c_associated, &
        c_f_pointer, c_loc, c_sizeof
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_bad_input, gapbeam_other_version
    use gapbeam_laws, only: parameters_of_law
    use gapbeam_scene, only: model_type, section_type, load_type, gapbeam_temperature
    use gapbeam_assembled_model, only: is_movement, is_of_support
    use gapbeam_capi_objects, only: check_flag
    implicit none
    private
    public :: c_model, is_model_size, empty_model, model_from_c, loads_from_c

    !> Mirror of the header's structure; tests/languages/test_capi.c compares the sizes
    type, bind(c) :: c_model
        integer(c_size_t) :: size
        integer(c_int) :: spans = 0
        type(c_ptr) :: length = c_null_ptr, EI = c_null_ptr, GA = c_null_ptr, EA = c_null_ptr
        integer(c_int) :: hinges = 0
        type(c_ptr) :: hinge_x = c_null_ptr
        integer(c_int) :: supports = 0
        type(c_ptr) :: support_x = c_null_ptr, support_node = c_null_ptr, support_side = c_null_ptr
        type(c_ptr) :: support_stiffness = c_null_ptr, support_gap = c_null_ptr, support_settlement = c_null_ptr
        type(c_ptr) :: support_rotation = c_null_ptr, support_direction = c_null_ptr
        integer(c_int) :: loads = 0
        type(c_ptr) :: load_kind = c_null_ptr, load_case = c_null_ptr, load_x = c_null_ptr, load_node = c_null_ptr
        type(c_ptr) :: load_to = c_null_ptr, load_value = c_null_ptr, load_value_to = c_null_ptr
        ! Not in the structure of version 0.2
        type(c_ptr) :: support_unloading = c_null_ptr
        integer(c_int) :: law_points = 0
        type(c_ptr) :: law_support = c_null_ptr, law_displacement = c_null_ptr, law_force = c_null_ptr
        ! Nor in that of version 0.3
        integer(c_int) :: foundations = 0
        type(c_ptr) :: foundation_from = c_null_ptr, foundation_to = c_null_ptr, foundation_side = c_null_ptr
        type(c_ptr) :: foundation_k = c_null_ptr, foundation_k_to = c_null_ptr
        type(c_ptr) :: foundation_gap = c_null_ptr, foundation_gap_to = c_null_ptr
        integer(c_int) :: profile_points = 0
        type(c_ptr) :: profile_foundation = c_null_ptr, profile_x = c_null_ptr, profile_gap = c_null_ptr
        integer(c_int) :: ground_law_points = 0
        type(c_ptr) :: ground_law_foundation = c_null_ptr, ground_law_displacement = c_null_ptr, ground_law_force = c_null_ptr
        type(c_ptr) :: foundation_law = c_null_ptr, foundation_parameter = c_null_ptr, foundation_parameter_to = c_null_ptr
        integer(c_int) :: table_points = 0
        type(c_ptr) :: table_foundation = c_null_ptr, table_quantity = c_null_ptr, table_x = c_null_ptr, table_value = c_null_ptr
        type(c_ptr) :: support_law = c_null_ptr, support_parameter = c_null_ptr, support_friction = c_null_ptr
        type(c_ptr) :: hinge_stiffness = c_null_ptr
        type(c_ptr) :: N = c_null_ptr, mass = c_null_ptr, foundation_shear = c_null_ptr
        integer(c_int) :: N_grows = 0, first_order = 0, stretching = 0, with_trains = 0, masses = 0
        type(c_ptr) :: mass_x = c_null_ptr, lumped_mass = c_null_ptr
        integer(c_int) :: sections = 0
        type(c_ptr) :: section_from = c_null_ptr, section_to = c_null_ptr
        type(c_ptr) :: section_EI = c_null_ptr, section_GA = c_null_ptr, section_EA = c_null_ptr
        type(c_ptr) :: section_EI_to = c_null_ptr, section_GA_to = c_null_ptr, section_EA_to = c_null_ptr
        type(c_ptr) :: section_EI_power = c_null_ptr, section_GA_power = c_null_ptr, section_EA_power = c_null_ptr
        type(c_ptr) :: section_friction = c_null_ptr, section_N = c_null_ptr
        type(c_ptr) :: section_friction_to = c_null_ptr, section_bedding = c_null_ptr
    end type c_model

contains

    !> Is a size one of the structure
    function is_model_size(size) result(is_size)
        integer(c_size_t), intent(in) :: size
        logical :: is_size

        is_size = any(size == sizes_of_model())
    end function is_model_size

    !> Sizes of the structure now, in version 0.3, without foundations, and in version 0.2, without laws too
    function sizes_of_model() result(sizes)
        integer(c_size_t) :: sizes(3)
        type(c_model), target :: c
        integer(c_intptr_t) :: begin

        begin = transfer(c_loc(c), begin)
        sizes(1) = c_sizeof(c)
        sizes(2) = transfer(c_loc(c%foundations), begin) - begin
        sizes(3) = transfer(c_loc(c%support_unloading), begin) - begin
    end function sizes_of_model

    !> Make a model empty
    subroutine empty_model(c, size)
        !> Nothing beyond its size is touched
        type(c_model), intent(inout), target :: c
        !> One of its sizes
        integer(c_size_t), intent(in) :: size
        integer(c_signed_char), pointer :: bytes(:)
        integer(c_signed_char) :: empty(c_sizeof(c))

        empty(:) = transfer(c_model(size), empty)
        call c_f_pointer(c_loc(c), bytes, [size])
        bytes(:) = empty(:size)
    end subroutine empty_model

    !> Copy a model; what is NULL keeps its default
    subroutine model_from_c(c, model, error)
        !> As the caller filled it
        type(c_model), intent(in) :: c
        type(model_type), intent(out) :: model
        !> Wrong size, a negative number of entries, a missing array, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(c_double), pointer :: reals(:)
        integer(c_int), pointer :: integers(:)
        integer(c_size_t) :: sizes(3)
        logical :: with_laws, with_all
        integer :: i, points, stat

        call check_size(c, error)
        if (allocated(error)) return
        sizes(:) = sizes_of_model()
        with_laws = c%size >= sizes(2)
        with_all = c%size == sizes(1)
        model%first_order = .not. with_all
        points = 0
        if (with_laws) then
            points = c%law_points
            call check_array("law points", c%law_points, c_associated(c%law_support) .and. c_associated(c%law_displacement) &
                             .and. c_associated(c%law_force), "law_support, law_displacement and law_force are needed", error)
        end if
        if (.not. allocated(error)) call check_array("spans", c%spans, c_associated(c%length) .and. c_associated(c%EI), &
                                                     "length and EI are needed", error)
        if (.not. allocated(error)) call check_array("hinges", c%hinges, c_associated(c%hinge_x), "hinge_x is needed", error)
        if (.not. allocated(error)) call check_array("supports", c%supports, c_associated(c%support_x) &
                                                     .or. c_associated(c%support_node), "support_x or support_node is needed", &
                                                     error)
        if (.not. allocated(error)) call loads_from_c(c, model%loads, error)
        if (.not. allocated(error) .and. with_all) then
            call check_array("masses", c%masses, c_associated(c%mass_x) .and. c_associated(c%lumped_mass), &
                             "mass_x and lumped_mass are needed", error)
            if (.not. allocated(error)) call check_array("supports", c%supports, c_associated(c%support_law) &
                                                         .eqv. c_associated(c%support_parameter), &
                                                         "support_law and support_parameter need each other", error)
            call check_flag("model: N_grows", c%N_grows, error)
            call check_flag("model: first_order", c%first_order, error)
            call check_flag("model: stretching", c%stretching, error)
            call check_flag("model: with_trains", c%with_trains, error)
            if (.not. allocated(error)) call foundations_from_c(c, model, error)
            if (.not. allocated(error)) call sections_from_c(c, model%sections, error)
        end if
        if (allocated(error)) return
        allocate (model%spans(c%spans), model%hinges(c%hinges), model%supports(c%supports), model%law(points), &
                  stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (s => model%spans, n => c%spans)
            if (has_reals(c%length, n, reals)) s%length = reals
            if (has_reals(c%EI, n, reals)) s%EI = reals
            if (has_reals(c%GA, n, reals)) s%GA = reals
            if (has_reals(c%EA, n, reals)) s%EA = reals
        end associate
        if (has_reals(c%hinge_x, c%hinges, reals)) model%hinges(:) = reals
        if (with_all) then
            if (has_reals(c%N, c%spans, reals)) model%spans%N = reals
            if (has_reals(c%mass, c%spans, reals)) model%spans%mass = reals
            model%N_grows = c%N_grows == 1
            model%first_order = c%first_order == 1
            model%stretching = c%stretching == 1
            model%with_trains = c%with_trains == 1
            allocate (model%masses(2, c%masses))
            if (has_reals(c%mass_x, c%masses, reals)) model%masses(1, :) = reals
            if (has_reals(c%lumped_mass, c%masses, reals)) model%masses(2, :) = reals
            allocate (model%hinge_stiffness(c%hinges), source=0.0_c_double)
            if (has_reals(c%hinge_stiffness, c%hinges, reals)) model%hinge_stiffness(:) = reals
        end if
        associate (s => model%supports, n => c%supports)
            if (has_reals(c%support_x, n, reals)) s%x = reals
            if (has_integers(c%support_node, n, integers)) s%node = integers
            if (has_integers(c%support_side, n, integers)) s%side = integers
            if (has_reals(c%support_stiffness, n, reals)) s%stiffness = reals
            if (has_reals(c%support_gap, n, reals)) s%gap = reals
            if (has_reals(c%support_settlement, n, reals)) s%settlement = reals
            if (has_reals(c%support_rotation, n, reals)) s%rotation = reals
            if (has_integers(c%support_direction, n, integers)) s%direction = integers
            if (.not. with_laws) return
            if (has_integers(c%support_unloading, n, integers)) s%unloading = integers
            if (with_all) then
                if (has_integers(c%support_law, n, integers)) s%law = integers
                if (has_reals(c%support_friction, n, reals)) s%friction = reals
                if (has_reals(c%support_parameter, n*parameters_of_law, reals)) then
                    do i = 1, n
                        s(i)%parameter = reals((i - 1)*parameters_of_law + 1:i*parameters_of_law)
                    end do
                end if
            end if
        end associate
        if (points == 0) return
        associate (law => model%law, n => c%law_points)
            if (has_integers(c%law_support, n, integers)) law%support = integers + 1
            if (has_reals(c%law_displacement, n, reals)) law%displacement = reals
            if (has_reals(c%law_force, n, reals)) law%force = reals
        end associate
    end subroutine model_from_c

    !> Copy the foundations of a model
    subroutine foundations_from_c(c, model, error)
        !> Of the structure's size now
        type(c_model), intent(in) :: c
        !> Their places in it are filled
        type(model_type), intent(inout) :: model
        !> As for model_from_c
        type(error_type), allocatable, intent(out) :: error
        real(c_double), pointer :: reals(:)
        integer(c_int), pointer :: integers(:)
        integer :: i, stat

        call check_array("foundations", c%foundations, c_associated(c%foundation_law) .eqv. c_associated(c%foundation_parameter), &
                         "foundation_law and foundation_parameter need each other", error)
        if (.not. allocated(error)) call check_array("foundations", c%foundations, c_associated(c%foundation_parameter) &
                                                     .or. .not. c_associated(c%foundation_parameter_to), &
                                                     "foundation_parameter is needed with foundation_parameter_to", error)
        if (.not. allocated(error)) call check_array("profile points", c%profile_points, c_associated(c%profile_foundation) &
                                                     .and. c_associated(c%profile_x) .and. c_associated(c%profile_gap), &
                                                     "profile_foundation, profile_x and profile_gap are needed", error)
        if (.not. allocated(error)) call check_array("table points", c%table_points, c_associated(c%table_foundation) &
                                                     .and. c_associated(c%table_quantity) .and. c_associated(c%table_x) &
                                                     .and. c_associated(c%table_value), "table_foundation, table_quantity, "// &
                                                     "table_x and table_value are needed", error)
        if (.not. allocated(error)) call check_array("ground law points", c%ground_law_points, &
                                                     c_associated(c%ground_law_foundation) .and. &
                                                     c_associated(c%ground_law_displacement) .and. &
                                                     c_associated(c%ground_law_force), "ground_law_foundation, "// &
                                                     "ground_law_displacement and ground_law_force are needed", error)
        if (allocated(error)) return
        stat = merge(1, 0, c%profile_points > huge(c%table_points) - c%table_points)
        if (stat == 0) allocate (model%foundations(c%foundations), model%ground(c%profile_points + c%table_points), &
                                 model%ground_law(c%ground_law_points), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (f => model%foundations, n => c%foundations)
            if (has_reals(c%foundation_from, n, reals)) f%from = reals
            if (has_reals(c%foundation_to, n, reals)) f%to = reals
            if (has_integers(c%foundation_side, n, integers)) f%side = integers
            if (has_reals(c%foundation_k, n, reals)) f%k = reals
            if (has_reals(c%foundation_k_to, n, reals)) f%k_to = reals
            if (has_reals(c%foundation_gap, n, reals)) f%gap = reals
            if (has_reals(c%foundation_gap_to, n, reals)) f%gap_to = reals
            if (has_reals(c%foundation_shear, n, reals)) f%shear = reals
            if (has_integers(c%foundation_law, n, integers)) f%law = integers
            if (has_reals(c%foundation_parameter, n*parameters_of_law, reals)) then
                do i = 1, n
                    f(i)%parameter = reals((i - 1)*parameters_of_law + 1:i*parameters_of_law)
                end do
            end if
            if (has_reals(c%foundation_parameter_to, n*parameters_of_law, reals)) then
                do i = 1, n
                    f(i)%parameter_to = reals((i - 1)*parameters_of_law + 1:i*parameters_of_law)
                end do
            end if
        end associate
        associate (points => model%ground(:c%profile_points), n => c%profile_points)
            if (has_integers(c%profile_foundation, n, integers)) points%foundation = integers + 1
            if (has_reals(c%profile_x, n, reals)) points%x = reals
            if (has_reals(c%profile_gap, n, reals)) points%value = reals
        end associate
        associate (points => model%ground(c%profile_points + 1:), n => c%table_points)
            if (has_integers(c%table_foundation, n, integers)) points%foundation = integers + 1
            if (has_integers(c%table_quantity, n, integers)) points%quantity = integers
            if (has_reals(c%table_x, n, reals)) points%x = reals
            if (has_reals(c%table_value, n, reals)) points%value = reals
        end associate
        associate (points => model%ground_law, n => c%ground_law_points)
            if (has_integers(c%ground_law_foundation, n, integers)) points%foundation = integers + 1
            if (has_reals(c%ground_law_displacement, n, reals)) points%displacement = reals
            if (has_reals(c%ground_law_force, n, reals)) points%force = reals
        end associate
    end subroutine foundations_from_c

    !> Copy the sections of a model
    subroutine sections_from_c(c, sections, error)
        !> Of the structure's size now
        type(c_model), intent(in) :: c
        type(section_type), allocatable, intent(out) :: sections(:)
        !> As for model_from_c
        type(error_type), allocatable, intent(out) :: error
        real(c_double), pointer :: reals(:)
        integer(c_int), pointer :: integers(:)
        integer :: stat

        call check_array("sections", c%sections, .true., "", error)
        if (allocated(error)) return
        allocate (sections(c%sections), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (s => sections, n => c%sections)
            if (has_reals(c%section_from, n, reals)) s%from = reals
            if (has_reals(c%section_to, n, reals)) s%to = reals
            if (has_reals(c%section_EI, n, reals)) s%EI = reals
            if (has_reals(c%section_GA, n, reals)) s%GA = reals
            if (has_reals(c%section_EA, n, reals)) s%EA = reals
            if (has_reals(c%section_EI_to, n, reals)) s%EI_to = reals
            if (has_reals(c%section_GA_to, n, reals)) s%GA_to = reals
            if (has_reals(c%section_EA_to, n, reals)) s%EA_to = reals
            if (has_integers(c%section_EI_power, n, integers)) s%EI_power = integers
            if (has_integers(c%section_GA_power, n, integers)) s%GA_power = integers
            if (has_integers(c%section_EA_power, n, integers)) s%EA_power = integers
            if (has_reals(c%section_friction, n, reals)) s%friction = reals
            if (has_reals(c%section_N, n, reals)) s%N = reals
            if (has_reals(c%section_friction_to, n, reals)) s%friction_to = reals
            if (has_reals(c%section_bedding, n, reals)) s%bedding = reals
        end associate
    end subroutine sections_from_c

    !> Copy the loads of a model
    subroutine loads_from_c(c, loads, error)
        type(c_model), intent(in) :: c
        type(load_type), allocatable, intent(out) :: loads(:)
        !> As for model_from_c
        type(error_type), allocatable, intent(out) :: error
        real(c_double), pointer :: reals(:)
        integer(c_int), pointer :: integers(:)
        integer :: i, stat

        call check_size(c, error)
        if (.not. allocated(error)) call check_array("loads", c%loads, c_associated(c%load_kind) .and. &
                                                     c_associated(c%load_value) .and. (c_associated(c%load_x) .or. &
                                                                                       c_associated(c%load_node)), &
                                                     "load_kind, load_value, and load_x or load_node are needed", error)
        if (allocated(error)) return
        allocate (loads(c%loads), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (n => c%loads)
            if (has_integers(c%load_kind, n, integers)) loads%kind = integers
            if (has_integers(c%load_case, n, integers)) loads%case = integers
            if (has_reals(c%load_x, n, reals)) loads%x = reals
            if (has_integers(c%load_node, n, integers)) loads%node = integers &
                + merge(1, 0, is_of_support(loads) .or. is_movement(loads))
            if (has_reals(c%load_to, n, reals)) loads%to = reals
            if (has_reals(c%load_value, n, reals)) loads%value = reals
            do i = 1, n
                if (loads(i)%kind /= gapbeam_temperature) loads(i)%value_to = loads(i)%value
            end do
            if (has_reals(c%load_value_to, n, reals)) loads%value_to = reals
        end associate
    end subroutine loads_from_c

    !> Is the structure the library's
    subroutine check_size(c, error)
        type(c_model), intent(in) :: c
        type(error_type), allocatable, intent(out) :: error

        if (.not. is_model_size(c%size)) then
            call fatal_error(error, gapbeam_other_version, "model: size is not the library's; use gapbeam_model_init")
        end if
    end subroutine check_size

    !> Refuse a negative number of entries, and arrays that are needed and not there
    subroutine check_array(name, number, given, problem, error)
        character(len=*), intent(in) :: name, problem
        integer(c_int), intent(in) :: number
        logical, intent(in) :: given
        type(error_type), allocatable, intent(out) :: error

        if (number < 0) then
            call fatal_error(error, gapbeam_bad_input, "model: the number of "//name//" is negative")
        else if (number > 0 .and. .not. given) then
            call fatal_error(error, gapbeam_bad_input, "model: "//problem)
        end if
    end subroutine check_array

    !> Is there an array of reals
    function has_reals(address, number, array) result(given)
        type(c_ptr), intent(in) :: address
        integer(c_int), intent(in) :: number
        real(c_double), pointer, intent(out) :: array(:)
        logical :: given

        nullify (array)
        given = c_associated(address)
        if (given) call c_f_pointer(address, array, [number])
    end function has_reals

    !> Is there an array of integers
    function has_integers(address, number, array) result(given)
        type(c_ptr), intent(in) :: address
        integer(c_int), intent(in) :: number
        integer(c_int), pointer, intent(out) :: array(:)
        logical :: given

        nullify (array)
        given = c_associated(address)
        if (given) call c_f_pointer(address, array, [number])
    end function has_integers

end module gapbeam_capi_model

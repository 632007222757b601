!> The model of the C interface, pointers to plain arrays, as the library's own
module gapbeam_capi_model
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_signed_char, c_intptr_t, c_ptr, c_null_ptr, c_associated, &
        c_f_pointer, c_loc, c_sizeof
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_bad_input, gapbeam_other_version
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
        integer(c_size_t) :: sizes(3)
        logical :: with_laws, with_all
        integer :: k, points, stat

        call check_size(c, error)
        if (allocated(error)) return
        sizes(:) = sizes_of_model()
        with_laws = c%size >= sizes(2)
        with_all = c%size == sizes(1)
        model%first_order = .not. with_all
        points = 0
        if (with_laws) then
            points = c%law_points
            call check_array("law points", points, have([c%law_support, c%law_displacement, c%law_force]), &
                             "law_support, law_displacement and law_force are needed", error)
        end if
        call check_array("spans", c%spans, have([c%length, c%EI]), "length and EI are needed", error)
        call check_array("hinges", c%hinges, have([c%hinge_x]), "hinge_x is needed", error)
        call check_array("supports", c%supports, have([c%support_x]) .or. have([c%support_node]), &
                         "support_x or support_node is needed", error)
        if (.not. allocated(error)) call loads_from_c(c, model%loads, error)
        if (.not. allocated(error) .and. with_all) then
            call check_array("masses", c%masses, have([c%mass_x, c%lumped_mass]), "mass_x and lumped_mass are needed", error)
            call check_array("supports", c%supports, have([c%support_law]) .eqv. have([c%support_parameter]), &
                             "support_law and support_parameter need each other", error)
            call check_flag("model: N_grows", c%N_grows, error)
            call check_flag("model: first_order", c%first_order, error)
            call check_flag("model: stretching", c%stretching, error)
            call check_flag("model: with_trains", c%with_trains, error)
            if (.not. allocated(error)) call foundations_from_c(c, model, error)
            if (.not. allocated(error)) call sections_from_c(c, model%sections, error)
        end if
        if (allocated(error)) return
        allocate (model%spans(c%spans), model%hinges(c%hinges), model%supports(c%supports), model%law(points), stat=stat)
        if (failed(stat, error)) return
        associate (s => model%spans)
            call copy_reals(c%length, s%length)
            call copy_reals(c%EI, s%EI)
            call copy_reals(c%GA, s%GA)
            call copy_reals(c%EA, s%EA)
        end associate
        call copy_reals(c%hinge_x, model%hinges)
        if (with_all) then
            call copy_reals(c%N, model%spans%N)
            call copy_reals(c%mass, model%spans%mass)
            model%N_grows = c%N_grows == 1
            model%first_order = c%first_order == 1
            model%stretching = c%stretching == 1
            model%with_trains = c%with_trains == 1
            allocate (model%masses(2, c%masses))
            call copy_reals(c%mass_x, model%masses(1, :))
            call copy_reals(c%lumped_mass, model%masses(2, :))
            allocate (model%hinge_stiffness(c%hinges), source=0.0_c_double)
            call copy_reals(c%hinge_stiffness, model%hinge_stiffness)
        end if
        associate (s => model%supports)
            call copy_reals(c%support_x, s%x)
            call copy_integers(c%support_node, s%node)
            call copy_integers(c%support_side, s%side)
            call copy_reals(c%support_stiffness, s%stiffness)
            call copy_reals(c%support_gap, s%gap)
            call copy_reals(c%support_settlement, s%settlement)
            call copy_reals(c%support_rotation, s%rotation)
            call copy_integers(c%support_direction, s%direction)
            if (.not. with_laws) return
            call copy_integers(c%support_unloading, s%unloading)
            if (with_all) then
                call copy_integers(c%support_law, s%law)
                call copy_reals(c%support_friction, s%friction)
                do k = 1, parameters_of_law
                    call copy_reals(c%support_parameter, s%parameter(k), k)
                end do
            end if
        end associate
        associate (law => model%law)
            call copy_integers(c%law_support, law%support)
            law%support = law%support + 1
            call copy_reals(c%law_displacement, law%displacement)
            call copy_reals(c%law_force, law%force)
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
        integer :: k, stat

        call check_array("foundations", c%foundations, have([c%foundation_law]) .eqv. have([c%foundation_parameter]), &
                         "foundation_law and foundation_parameter need each other", error)
        call check_array("foundations", c%foundations, have([c%foundation_parameter]) &
                         .or. .not. have([c%foundation_parameter_to]), &
                         "foundation_parameter is needed with foundation_parameter_to", error)
        call check_array("profile points", c%profile_points, have([c%profile_foundation, c%profile_x, c%profile_gap]), &
                         "profile_foundation, profile_x and profile_gap are needed", error)
        call check_array("table points", c%table_points, have([c%table_foundation, c%table_quantity, c%table_x, c%table_value]), &
                         "table_foundation, table_quantity, table_x and table_value are needed", error)
        call check_array("ground law points", c%ground_law_points, &
                         have([c%ground_law_foundation, c%ground_law_displacement, c%ground_law_force]), &
                         "ground_law_foundation, ground_law_displacement and ground_law_force are needed", error)
        if (allocated(error)) return
        stat = merge(1, 0, c%profile_points > huge(c%table_points) - c%table_points)
        if (stat == 0) allocate (model%foundations(c%foundations), model%ground(c%profile_points + c%table_points), &
                                 model%ground_law(c%ground_law_points), stat=stat)
        if (failed(stat, error)) return
        associate (f => model%foundations)
            call copy_reals(c%foundation_from, f%from)
            call copy_reals(c%foundation_to, f%to)
            call copy_integers(c%foundation_side, f%side)
            call copy_reals(c%foundation_k, f%k)
            call copy_reals(c%foundation_k_to, f%k_to)
            call copy_reals(c%foundation_gap, f%gap)
            call copy_reals(c%foundation_gap_to, f%gap_to)
            call copy_reals(c%foundation_shear, f%shear)
            call copy_integers(c%foundation_law, f%law)
            do k = 1, parameters_of_law
                call copy_reals(c%foundation_parameter, f%parameter(k), k)
                call copy_reals(c%foundation_parameter_to, f%parameter_to(k), k)
            end do
        end associate
        associate (points => model%ground(:c%profile_points))
            call copy_integers(c%profile_foundation, points%foundation)
            points%foundation = points%foundation + 1
            call copy_reals(c%profile_x, points%x)
            call copy_reals(c%profile_gap, points%value)
        end associate
        associate (points => model%ground(c%profile_points + 1:))
            call copy_integers(c%table_foundation, points%foundation)
            points%foundation = points%foundation + 1
            call copy_integers(c%table_quantity, points%quantity)
            call copy_reals(c%table_x, points%x)
            call copy_reals(c%table_value, points%value)
        end associate
        associate (points => model%ground_law)
            call copy_integers(c%ground_law_foundation, points%foundation)
            points%foundation = points%foundation + 1
            call copy_reals(c%ground_law_displacement, points%displacement)
            call copy_reals(c%ground_law_force, points%force)
        end associate
    end subroutine foundations_from_c

    !> Copy the sections of a model
    subroutine sections_from_c(c, sections, error)
        !> Of the structure's size now
        type(c_model), intent(in) :: c
        type(section_type), allocatable, intent(out) :: sections(:)
        !> As for model_from_c
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        call check_array("sections", c%sections, .true., "", error)
        if (allocated(error)) return
        allocate (sections(c%sections), stat=stat)
        if (failed(stat, error)) return
        associate (s => sections)
            call copy_reals(c%section_from, s%from)
            call copy_reals(c%section_to, s%to)
            call copy_reals(c%section_EI, s%EI)
            call copy_reals(c%section_GA, s%GA)
            call copy_reals(c%section_EA, s%EA)
            call copy_reals(c%section_EI_to, s%EI_to)
            call copy_reals(c%section_GA_to, s%GA_to)
            call copy_reals(c%section_EA_to, s%EA_to)
            call copy_integers(c%section_EI_power, s%EI_power)
            call copy_integers(c%section_GA_power, s%GA_power)
            call copy_integers(c%section_EA_power, s%EA_power)
            call copy_reals(c%section_friction, s%friction)
            call copy_reals(c%section_N, s%N)
            call copy_reals(c%section_friction_to, s%friction_to)
            call copy_reals(c%section_bedding, s%bedding)
        end associate
    end subroutine sections_from_c

    !> Copy the loads of a model
    subroutine loads_from_c(c, loads, error)
        type(c_model), intent(in) :: c
        type(load_type), allocatable, intent(out) :: loads(:)
        !> As for model_from_c
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        call check_size(c, error)
        call check_array("loads", c%loads, have([c%load_kind, c%load_value]) .and. (have([c%load_x]) .or. have([c%load_node])), &
                         "load_kind, load_value, and load_x or load_node are needed", error)
        if (allocated(error)) return
        allocate (loads(c%loads), stat=stat)
        if (failed(stat, error)) return
        call copy_integers(c%load_kind, loads%kind)
        call copy_integers(c%load_case, loads%case)
        call copy_reals(c%load_x, loads%x)
        call copy_integers(c%load_node, loads%node)
        if (have([c%load_node])) loads%node = loads%node + merge(1, 0, is_of_support(loads) .or. is_movement(loads))
        call copy_reals(c%load_to, loads%to)
        call copy_reals(c%load_value, loads%value)
        do i = 1, size(loads)
            if (loads(i)%kind /= gapbeam_temperature) loads(i)%value_to = loads(i)%value
        end do
        call copy_reals(c%load_value_to, loads%value_to)
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
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error

        if (allocated(error)) return
        if (number < 0) then
            call fatal_error(error, gapbeam_bad_input, "model: the number of "//name//" is negative")
        else if (number > 0 .and. .not. given) then
            call fatal_error(error, gapbeam_bad_input, "model: "//problem)
        end if
    end subroutine check_array

    !> Are all of some arrays there
    pure function have(arrays)
        type(c_ptr), intent(in) :: arrays(:)
        logical :: have
        integer :: i

        have = all([(c_associated(arrays(i)), i=1, size(arrays))])
    end function have

    !> Copy an array of reals, if it is there
    subroutine copy_reals(address, values, parameter)
        type(c_ptr), intent(in) :: address
        !> Left as they are if it is not
        real(c_double), intent(inout) :: values(:)
        !> Where the array has all parameters of a law for every value: which one of them
        integer, intent(in), optional :: parameter
        real(c_double), pointer :: array(:)

        if (.not. c_associated(address)) return
        if (present(parameter)) then
            call c_f_pointer(address, array, [parameters_of_law*size(values)])
            values(:) = array(parameter::parameters_of_law)
        else
            call c_f_pointer(address, array, [size(values)])
            values(:) = array
        end if
    end subroutine copy_reals

    !> The same with integers
    subroutine copy_integers(address, values)
        type(c_ptr), intent(in) :: address
        integer, intent(inout) :: values(:)
        integer(c_int), pointer :: array(:)

        if (.not. c_associated(address)) return
        call c_f_pointer(address, array, [size(values)])
        values(:) = array
    end subroutine copy_integers

end module gapbeam_capi_model

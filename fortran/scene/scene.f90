!> Types of what a user describes: spans, hinges, supports, foundations and loads.
!>
!> Units: any consistent set. Signs: x from the left end to the right; deflections, settlements and loads positive down,
!> reactions up, moments sagging, couples and rotations clockwise; axial forces on the beam to the right, inside it tension.
module gapbeam_scene
    use gapbeam_kinds, only: wp, gapbeam_infinity => infinity
    use gapbeam_laws, only: gapbeam_law_by_points => law_by_points, gapbeam_law_plastic => law_plastic, &
        gapbeam_law_hardening => law_hardening, gapbeam_law_hyperbolic => law_hyperbolic, gapbeam_law_tanh => law_tanh, &
        gapbeam_law_cubic => law_cubic, gapbeam_law_power => law_power, gapbeam_law_brittle => law_brittle, parameters_of_law
    implicit none
    private
    public :: span_type, section_type, support_type, law_point_type, load_type, model_type, foundation_type, ground_point_type, &
              ground_law_point_type
    public :: point_force, point_couple, uniform_load, linear_load, imposed_curvature, linear_curvature, axial_force, &
              axial_uniform_load, support_movement, temperature_load, support_rotation, ground_movement
    public :: gapbeam_infinity, gapbeam_by_x, gapbeam_unchanged, gapbeam_right_end
    public :: gapbeam_both, gapbeam_below, gapbeam_above, gapbeam_left, gapbeam_right, gapbeam_counterclockwise, gapbeam_clockwise
    public :: gapbeam_normal, gapbeam_axial, gapbeam_rotational, gapbeam_relative, gapbeam_rotational_left, &
              gapbeam_rotational_right, gapbeam_force, gapbeam_couple, gapbeam_distributed, gapbeam_curvature, &
              gapbeam_axial_force, gapbeam_movement, gapbeam_temperature, gapbeam_support_rotation, gapbeam_couple_left, &
              gapbeam_couple_right, gapbeam_axial_distributed, gapbeam_ground_movement, gapbeam_linear_curvature
    public :: gapbeam_live, gapbeam_dead, gapbeam_elastic, gapbeam_plastic, gapbeam_broken, gapbeam_table_of_k, &
              gapbeam_table_of_gap, gapbeam_table_of_parameter
    public :: gapbeam_law_by_points, gapbeam_law_plastic, gapbeam_law_hardening, gapbeam_law_hyperbolic, gapbeam_law_tanh, &
              gapbeam_law_cubic, gapbeam_law_power, gapbeam_law_brittle

    !> Instead of a node: the place is given by x
    integer, parameter :: gapbeam_by_x = -1
    !> Sides of a support or foundation: holds the beam both ways, pushes it up only, pushes it down only
    integer, parameter :: gapbeam_both = 0, gapbeam_below = 1, gapbeam_above = -1
    !> Of an axial one: pushes it to the left only, to the right only
    integer, parameter :: gapbeam_left = 1, gapbeam_right = -1
    !> Of one that holds a rotation: turns the beam counterclockwise only, clockwise only
    integer, parameter :: gapbeam_counterclockwise = 1, gapbeam_clockwise = -1
    !> Directions of a support: across the beam, along it; it holds the rotation of the beam, or as a hinge the parts on its two
    !> sides against each other
    integer, parameter :: gapbeam_normal = 0, gapbeam_axial = 1, gapbeam_rotational = 2, gapbeam_relative = 3
    !> At a hinge: it holds the rotation of the part of the beam left of that, or right of it
    integer, parameter :: gapbeam_rotational_left = 4, gapbeam_rotational_right = 5
    !> Kinds of load
    integer, parameter :: gapbeam_force = 1, gapbeam_couple = 2, gapbeam_distributed = 3, gapbeam_curvature = 4, &
                          gapbeam_axial_force = 5, gapbeam_movement = 6, gapbeam_temperature = 7, gapbeam_support_rotation = 8, &
                          gapbeam_couple_left = 9, gapbeam_couple_right = 10, gapbeam_axial_distributed = 11, &
                          gapbeam_ground_movement = 12, gapbeam_linear_curvature = 13
    !> Cases of a load: scaled by the load factor, in full from the start
    integer, parameter :: gapbeam_live = 0, gapbeam_dead = 1
    !> How a support with a law unloads: back along it, parallel to its first piece, or not at all once its force has fallen
    integer, parameter :: gapbeam_elastic = 0, gapbeam_plastic = 1, gapbeam_broken = 2
    !> Of what a table of a foundation is: its modulus, its gap, the first parameter of its law; the other parameters follow
    integer, parameter :: gapbeam_table_of_k = 1, gapbeam_table_of_gap = 2, gapbeam_table_of_parameter = 3
    !> Instead of a stiffness of a section: it stays as it is; of a number at the right end of a foundation: it is that at the left.
    !> Instead of where a stretch ends: the right end of the beam
    real(wp), parameter :: gapbeam_unchanged = -huge(1.0_wp), gapbeam_right_end = -huge(1.0_wp)
    !> A place not given
    real(wp), parameter :: nowhere = -huge(1.0_wp)

    !> A stretch of constant stiffness; the stretches follow each other from left to right
    type :: span_type
        !> Length, above 0
        real(wp) :: length
        !> Bending stiffness (force*length**2), above 0; infinite: rigid
        real(wp) :: EI
        !> Shear stiffness kappa*G*A (force); infinite: Euler-Bernoulli
        real(wp) :: GA = gapbeam_infinity
        !> Axial stiffness (force); needed only with axial loads
        real(wp) :: EA = gapbeam_infinity
        !> Axial force that bending feels (second order), tension positive
        real(wp) :: N = 0.0_wp
        !> Mass per length, for frequencies: in the unit of force times the square of that of time over that of length
        real(wp) :: mass = 0.0_wp
    end type span_type

    !> Other stiffness between two places; later sections win over earlier ones
    type :: section_type
        !> Ends of the stretch
        real(wp) :: from = 0.0_wp, to = gapbeam_right_end
        !> Stiffnesses there, above 0, as in span_type
        real(wp) :: EI = gapbeam_unchanged, GA = gapbeam_unchanged, EA = gapbeam_unchanged
        !> The same at its right end, where they change along it, and the powers of a linear depth that they are, 1 to most_power
        real(wp) :: EI_to = gapbeam_unchanged, GA_to = gapbeam_unchanged, EA_to = gapbeam_unchanged
        integer :: EI_power = 1, GA_power = 1, EA_power = 1
        !> Most force per length of ground along the axis, 0: no ground, infinite: no limit; at its right end; its stiffness
        real(wp) :: friction = 0.0_wp, friction_to = gapbeam_unchanged, bedding = gapbeam_infinity
        !> Axial force there, as in span_type
        real(wp) :: N = gapbeam_unchanged
    end type section_type

    !> A support: it acts where the deflection reaches settlement + gap (below) or settlement - gap (above). Of one that holds a
    !> rotation that is clockwise (gapbeam_rotational), or that of the part on the left less that on the right (gapbeam_relative,
    !> which makes a hinge), and lengths are angles, forces couples: a positive one turns the beam counterclockwise, or sags it
    type :: support_type
        !> Place by x, anywhere along the beam
        real(wp) :: x = nowhere
        !> Or by node: 0 the left end, i the right end of span i; gapbeam_by_x: x counts
        integer :: node = gapbeam_by_x
        !> gapbeam_both, gapbeam_below or gapbeam_above; along the beam gapbeam_both, gapbeam_left or gapbeam_right: which way it
        !> pushes; of a rotation gapbeam_both, gapbeam_counterclockwise (of a hinge: sagging) or gapbeam_clockwise (hogging)
        integer :: side = gapbeam_both
        !> Force per length; infinite: rigid; 0 and one-sided: it never carries
        real(wp) :: stiffness = gapbeam_infinity
        !> Distance to be closed before it acts; negative: lack of fit; one-sided supports only
        real(wp) :: gap = 0.0_wp
        !> Movement of the support itself, down; of an axial one to the right
        real(wp) :: settlement = 0.0_wp
        !> Rotational stiffness (force*length/rad): 0 free, infinite clamped; it acts where the support is open too, as a guide
        real(wp) :: rotation = 0.0_wp
        !> gapbeam_normal, gapbeam_axial, gapbeam_rotational, gapbeam_relative; gapbeam_rotational_left or _right at a hinge
        integer :: direction = gapbeam_normal
        !> Of a support with a law: gapbeam_elastic, gapbeam_plastic or gapbeam_broken
        integer :: unloading = gapbeam_elastic
        !> Instead of a stiffness or a law by points: gapbeam_law_plastic, _brittle, _hyperbolic or _tanh, with stiffness
        !> (force/length) and limit (force); gapbeam_law_hardening, with stiffness, limit and the slope beyond; gapbeam_law_cubic,
        !> with k1, k2 and k3 (force/length to force/length**3); gapbeam_law_power, with d0 (length), limit and exponent
        integer :: law = gapbeam_law_by_points
        real(wp) :: parameter(parameters_of_law) = 0.0_wp
        !> Of a support across the beam: friction coefficient. It holds the beam along its axis with a force up to that times its
        !> reaction, and slips beyond
        real(wp) :: friction = 0.0_wp
    end type support_type

    !> A point of the law of a support, which has one instead of a stiffness: a polyline from (0, 0) through its points, in which
    !> equal displacements are a vertical piece, and whose last slope goes on; a support that holds both ways has it both ways
    type :: law_point_type
        !> Number of the support, from 1; its points stand beside each other
        integer :: support
        !> Displacement past the gap, not below that of the point before; force, 0 or more
        real(wp) :: displacement, force
    end type law_point_type

    !> Ground under a stretch of the beam, which pushes back by its modulus or by a law wherever the beam touches it
    type :: foundation_type
        !> Ends of the stretch
        real(wp) :: from = 0.0_wp, to = gapbeam_right_end
        !> Modulus (force/length**2) at its left and right end, linear in between, 0 or more; 0 where there is a law or a table
        !> instead
        real(wp) :: k = 0.0_wp, k_to = gapbeam_unchanged
        !> gapbeam_both, gapbeam_below or gapbeam_above
        integer :: side = gapbeam_both
        !> Distance to be closed before it acts, at its left and right end, linear in between; negative: lack of fit; 0 where there
        !> is a table instead
        real(wp) :: gap = 0.0_wp, gap_to = gapbeam_unchanged
        !> Instead of a modulus or a law by points: gapbeam_law_plastic, _hyperbolic or _tanh, with stiffness (force/length**2) and
        !> limit (force/length); gapbeam_law_hardening, with stiffness, limit and the slope beyond; gapbeam_law_cubic, with k1, k2
        !> and k3 (force/length**2 to **4)
        integer :: law = gapbeam_law_by_points
        !> Those at its left and right end, linear in between, 0 or more (k2 of any sign); 0 where there is a table instead
        real(wp) :: parameter(parameters_of_law) = 0.0_wp, parameter_to(parameters_of_law) = gapbeam_unchanged
        !> Second parameter (force): with what the ground resists differences of its deflection, shear times slope (Pasternak 1954)
        real(wp) :: shear = 0.0_wp
    end type foundation_type

    !> A point of a table of a foundation, which has one instead of a number or two: straight in between, beyond its ends the last
    !> value. A table of gaps is the profile of the ground
    type :: ground_point_type
        !> Number of the foundation, from 1; the points of a table stand beside each other, in ascending order of x
        integer :: foundation
        !> Place, also outside the foundation, and the value there. Two points at a place are a step, but of a gap
        real(wp) :: x, value
        !> gapbeam_table_of_k, gapbeam_table_of_gap, or gapbeam_table_of_parameter plus 0, 1 or 2
        integer :: quantity = gapbeam_table_of_gap
    end type ground_point_type

    !> A point of the law of a foundation, which has one instead of a modulus: a polyline from (0, 0) through its points, whose last
    !> slope goes on; a foundation that holds both ways has it both ways
    type :: ground_law_point_type
        !> Number of the foundation, from 1; its points stand beside each other
        integer :: foundation
        !> Displacement past the gap, above that of the point before; force per length, not below that of the point before
        real(wp) :: displacement, force
        !> Place at which the law is that, also outside the foundation; gapbeam_unchanged: everywhere. The laws at several places
        !> follow each other in ascending order of x, each with as many points, which are linear in between
        real(wp) :: x = gapbeam_unchanged
    end type ground_law_point_type

    !> A load; the functions below make one of each kind
    type :: load_type
        !> gapbeam_force, gapbeam_couple, gapbeam_distributed, gapbeam_curvature, gapbeam_axial_force, gapbeam_movement,
        !> gapbeam_temperature, gapbeam_support_rotation, gapbeam_couple_left, gapbeam_couple_right, gapbeam_axial_distributed,
        !> gapbeam_ground_movement or gapbeam_linear_curvature
        integer :: kind
        !> gapbeam_live or gapbeam_dead
        integer :: case = gapbeam_live
        !> Place, or left end of the stretch
        real(wp) :: x = nowhere
        !> Or place by node, of forces and couples; gapbeam_by_x: x counts. Of a movement or a rotation the number of its support,
        !> from 1; of a movement of ground that of its foundation
        integer :: node = gapbeam_by_x
        !> Right end of the stretch, of distributed loads and curvatures; default that of the beam
        real(wp) :: to = gapbeam_right_end
        !> Force, couple, curvature, movement, rotation, or force per length or curvature at the left end of the stretch
        real(wp) :: value = 0.0_wp
        !> Force per length, curvature or movement of ground at its right end; of a temperature the strain, value the curvature
        real(wp) :: value_to = 0.0_wp
    end type load_type

    !> A beam with all that is on it; what is not allocated is not there
    type :: model_type
        type(span_type), allocatable :: spans(:)
        !> Places of lumped masses, and these in the unit of force times the square of that of time over length, shape (2, :)
        real(wp), allocatable :: masses(:, :)
        !> Places of moment hinges, and couple per relative rotation of each (force*length); not allocated: none
        real(wp), allocatable :: hinges(:), hinge_stiffness(:)
        type(section_type), allocatable :: sections(:)
        type(support_type), allocatable :: supports(:)
        !> Points of the laws of those that have one
        type(law_point_type), allocatable :: law(:)
        type(foundation_type), allocatable :: foundations(:)
        !> Points of the tables and of the laws of those that have one
        type(ground_point_type), allocatable :: ground(:)
        type(ground_law_point_type), allocatable :: ground_law(:)
        type(load_type), allocatable :: loads(:)
        !> Does N grow with the factor; may axial loads not bend it; do they (prepared); does bending stretch it; do trains go
        logical :: N_grows = .false., first_order = .false., axial_loads_bend = .false., stretching = .false., with_trains = .false.
    end type model_type

contains

    !> A force across the beam
    elemental function point_force(value, x, node, case) result(load)
        !> Force, positive down
        real(wp), intent(in) :: value
        !> Place by x, or by node
        real(wp), intent(in), optional :: x
        integer, intent(in), optional :: node
        !> gapbeam_live (default) or gapbeam_dead
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = point_load(gapbeam_force, value, x, node, case)
    end function point_force

    !> A couple
    elemental function point_couple(value, x, node, case) result(load)
        !> Couple (force*length), positive clockwise; not exactly at a hinge
        real(wp), intent(in) :: value
        !> As for point_force
        real(wp), intent(in), optional :: x
        integer, intent(in), optional :: node, case
        type(load_type) :: load

        load = point_load(gapbeam_couple, value, x, node, case)
    end function point_couple

    !> A force along the beam; some support with direction gapbeam_axial must hold it
    elemental function axial_force(value, x, node, case) result(load)
        !> Force, positive to the right
        real(wp), intent(in) :: value
        !> As for point_force
        real(wp), intent(in), optional :: x
        integer, intent(in), optional :: node, case
        type(load_type) :: load

        load = point_load(gapbeam_axial_force, value, x, node, case)
    end function axial_force

    !> A constant load along the beam over a stretch; some support with direction gapbeam_axial must hold it
    elemental function axial_uniform_load(value, from, to, case) result(load)
        !> Force per length, positive to the right
        real(wp), intent(in) :: value
        !> As for uniform_load
        real(wp), intent(in) :: from, to
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = stretch_load(gapbeam_axial_distributed, value, value, from, to, case)
    end function axial_uniform_load

    !> A movement of a support across the beam, further than its settlement: what jacks, sinks or is lifted by heat
    elemental function support_movement(value, support, case) result(load)
        !> Movement, positive down
        real(wp), intent(in) :: value
        !> Number of the support, from 1
        integer, intent(in) :: support
        !> gapbeam_live (default: it grows with the load factor) or gapbeam_dead
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = point_load(gapbeam_movement, value, node=support, case=case)
    end function support_movement

    !> A movement of a foundation: the deflections at which the ground begins to act grow by it
    elemental function ground_movement(value, foundation, value_to, case) result(load)
        !> Movement at the left end of the foundation, positive down
        real(wp), intent(in) :: value
        !> Number of the foundation, from 1
        integer, intent(in) :: foundation
        !> The same at its right end, linear in between; default as at the left
        real(wp), intent(in), optional :: value_to
        !> gapbeam_live (default: it grows with the load factor) or gapbeam_dead
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = point_load(gapbeam_ground_movement, value, node=foundation, case=case)
        load%value_to = value
        if (present(value_to)) load%value_to = value_to
    end function ground_movement

    !> A rotation of a support that holds that of the beam, rigidly or by a spring
    elemental function support_rotation(value, support, case) result(load)
        !> Rotation, positive clockwise
        real(wp), intent(in) :: value
        !> Number of the support, from 1
        integer, intent(in) :: support
        !> gapbeam_live (default: it grows with the load factor) or gapbeam_dead
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = point_load(gapbeam_support_rotation, value, node=support, case=case)
    end function support_rotation

    !> A constant load over a stretch
    elemental function uniform_load(value, from, to, case) result(load)
        !> Force per length, positive down
        real(wp), intent(in) :: value
        !> Ends of the stretch
        real(wp), intent(in) :: from, to
        !> gapbeam_live (default) or gapbeam_dead
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = linear_load(value, value, from, to, case)
    end function uniform_load

    !> A linearly varying load over a stretch
    elemental function linear_load(value, value_to, from, to, case) result(load)
        !> Force per length at the left and at the right end of the stretch, positive down
        real(wp), intent(in) :: value, value_to
        !> As for uniform_load
        real(wp), intent(in) :: from, to
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = stretch_load(gapbeam_distributed, value, value_to, from, to, case)
    end function linear_load

    !> An imposed curvature over a stretch (temperature, shrinkage, prestress)
    elemental function imposed_curvature(value, from, to, case) result(load)
        !> Curvature (1/length), added to w'' = -M/EI; positive where the upper side gets longer
        real(wp), intent(in) :: value
        !> As for uniform_load
        real(wp), intent(in) :: from, to
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = stretch_load(gapbeam_curvature, value, value, from, to, case)
    end function imposed_curvature

    !> An imposed curvature that varies linearly over a stretch
    elemental function linear_curvature(value, value_to, from, to, case) result(load)
        !> At the left and at the right end of the stretch, as for imposed_curvature
        real(wp), intent(in) :: value, value_to
        !> As for uniform_load
        real(wp), intent(in) :: from, to
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = stretch_load(gapbeam_linear_curvature, value, value_to, from, to, case)
    end function linear_curvature

    !> A temperature over a stretch: what it bends and lengthens where nothing holds the beam
    elemental function temperature_load(curvature, strain, from, to, case) result(load)
        !> As for imposed_curvature; alpha times the difference over the depth, and elongation per length: alpha times the rise
        real(wp), intent(in) :: curvature, strain
        !> As for uniform_load
        real(wp), intent(in) :: from, to
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = stretch_load(gapbeam_temperature, curvature, strain, from, to, case)
    end function temperature_load

    !> A load over a stretch
    elemental function stretch_load(kind, value, value_to, from, to, case) result(load)
        integer, intent(in) :: kind
        real(wp), intent(in) :: value, value_to, from, to
        integer, intent(in), optional :: case
        type(load_type) :: load

        load = load_type(kind=kind, x=from, to=to, value=value, value_to=value_to)
        if (present(case)) load%case = case
    end function stretch_load

    !> A load at one place
    elemental function point_load(kind, value, x, node, case) result(load)
        integer, intent(in) :: kind
        real(wp), intent(in) :: value
        real(wp), intent(in), optional :: x
        integer, intent(in), optional :: node, case
        type(load_type) :: load

        load = load_type(kind=kind, value=value)
        if (present(x)) load%x = x
        if (present(node)) load%node = node
        if (present(case)) load%case = case
    end function point_load

end module gapbeam_scene

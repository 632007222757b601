!> Kinds of node between two links
module gapbeam_nodes
    implicit none
    private
    public :: plain, hinge, restrained, jointed, hinge_left, hinge_right, joint_left, joint_right
    public :: is_through, is_hinge, is_restrained, takes_left, takes_right

    !> The moment is the same on both sides; it is known, mostly zero; a rotational restraint takes a share of it; it is the same,
    !> and turns what is on the two sides against each other
    integer, parameter :: plain = 0, hinge = 1, restrained = 2, jointed = 3
    !> A hinge, and a joint, with a rotational restraint of what is left or right of it
    integer, parameter :: hinge_left = 4, hinge_right = 5, joint_left = 6, joint_right = 7

contains

    !> Is the moment at a node one unknown, the same on both sides
    elemental function is_through(kind) result(through)
        integer, intent(in) :: kind
        logical :: through

        through = kind == plain .or. kind == jointed
    end function is_through

    !> Is the moment known on one side at least
    elemental function is_hinge(kind) result(it_is)
        integer, intent(in) :: kind
        logical :: it_is

        it_is = kind == hinge .or. kind == hinge_left .or. kind == hinge_right
    end function is_hinge

    !> Does a rotational restraint take a share of the moment, on one side at least
    elemental function is_restrained(kind) result(it_is)
        integer, intent(in) :: kind
        logical :: it_is

        it_is = kind == restrained .or. kind >= hinge_left
    end function is_restrained

    !> Is the moment left of a node an unknown for itself, since a restraint takes a share of it
    elemental function takes_left(kind) result(it_does)
        integer, intent(in) :: kind
        logical :: it_does

        it_does = kind == restrained .or. kind == hinge_left .or. kind >= joint_left
    end function takes_left

    !> The same of the moment right of it
    elemental function takes_right(kind) result(it_does)
        integer, intent(in) :: kind
        logical :: it_does

        it_does = kind == restrained .or. kind == hinge_right .or. kind >= joint_left
    end function takes_right

end module gapbeam_nodes

!> Kinds of node between two links
module gapbeam_nodes
    implicit none
    private
    public :: plain, hinge, restrained, jointed, is_through

    !> The moment is the same on both sides; it is known, mostly zero; a rotational restraint takes a share of it; it is the same,
    !> and turns what is on the two sides against each other
    integer, parameter :: plain = 0, hinge = 1, restrained = 2, jointed = 3

contains

    !> Is the moment at a node one unknown, the same on both sides
    elemental function is_through(kind) result(through)
        integer, intent(in) :: kind
        logical :: through

        through = kind == plain .or. kind == jointed
    end function is_through

end module gapbeam_nodes

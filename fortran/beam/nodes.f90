!> Kinds of node between two links
module gapbeam_nodes
    implicit none
    private
    public :: plain, hinge, restrained

    !> The moment is the same on both sides; it is zero; a rotational restraint takes a share of it
    integer, parameter :: plain = 0, hinge = 1, restrained = 2
end module gapbeam_nodes

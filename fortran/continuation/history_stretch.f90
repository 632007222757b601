!> A stretch of a load path, on which all pieces of all laws stay the same.
!>
!> Of its pieces that is kept which differs from the stretch before, and now and then all of them: so a path takes memory for what
!> changes along it, and the pieces of any stretch are found from the last one with all of them.
module gapbeam_history_stretch
    use gapbeam_kinds, only: wp
    use gapbeam_polyline, only: node_support_type
    implicit none
    private
    public :: stretch_type, pieces_type, keep_pieces, nothing_changes, enter_stretch, hand_over, same_laws

    !> A stretch of the path
    type :: stretch_type
        !> Number of the factor that is gone to, from 1; 0 while the dead loads are put on
        integer :: leg
        !> Load factors
        real(wp) :: from, to
        !> Does the load rise (1), fall (-1), or does the beam turn at constant load (0); in how many ways the beam gives way by
        !> itself; ways on there were at its beginning
        integer :: direction, index, ways
        !> Is it passed in a jump
        logical :: skipped
        !> Breakpoints that differ from the stretch before, where only these are kept; the last stretch with all of them
        integer, allocatable :: changed(:)
        integer :: whole = 0
        !> Of these, or of all: the scheme; the laws as they have become, where they are not those of the beam
        logical, allocatable :: closed(:)
        type(node_support_type), allocatable :: laws(:)
        !> Where friction is to be followed beside it: breakpoints whose reactions have other lines over the load factor than on the
        !> stretch before, and these: at factor 0, and by a unit of it, shape (2, size(pressed)); none where they are not known
        integer, allocatable :: pressed(:)
        real(wp), allocatable :: reactions(:, :)
        !> Of links along the beam: their scheme, and which numbers of the chain are at the ends
        logical, allocatable :: along(:)
        integer :: ends(2) = 0
        !> Contacts of their laws as they are at its beginning, where some keep a set, shape (size(axial%laws))
        real(wp), allocatable :: along_contact(:)
        !> Is the chain free there, so that forces are unique and its position is not
        logical :: loose = .false.
    end type stretch_type

    !> The pieces of all supports on a stretch: the scheme; the laws, where they are not those of the beam
    type :: pieces_type
        logical, allocatable :: closed(:)
        type(node_support_type), allocatable :: laws(:)
        !> Breakpoints kept since the last stretch with all of them
        integer :: number = 0
    end type pieces_type

contains

    !> Keep the pieces of all supports on a stretch that comes next
    pure subroutine keep_pieces(places, closed, laws, last, stretch)
        !> Breakpoints among which are all that differ from those on the last stretch; all where there is none
        integer, intent(in) :: places(:)
        !> Of these: the scheme; the laws, not allocated if laws do not change
        logical, intent(in) :: closed(:)
        type(node_support_type), allocatable, intent(in) :: laws(:)
        !> On the last stretch
        type(pieces_type), intent(in) :: last
        type(stretch_type), intent(inout) :: stretch
        logical, allocatable :: differs(:)

        if (.not. allocated(last%closed)) then
            stretch%closed = closed
            if (allocated(laws)) stretch%laws = laws
            return
        end if
        allocate (differs(size(places)), source=closed .neqv. last%closed(places))
        if (allocated(laws)) differs(:) = differs .or. .not. same_law(laws, last%laws(places))
        if (2*(last%number + count(differs)) <= size(last%closed)) then
            stretch%changed = pack(places, differs)
            stretch%closed = pack(closed, differs)
            if (allocated(laws)) stretch%laws = pack(laws, differs)
        else
            stretch%closed = last%closed
            stretch%closed(places) = closed
            if (.not. allocated(laws)) return
            stretch%laws = last%laws
            stretch%laws(places) = laws
        end if
    end subroutine keep_pieces

    !> Let the pieces of a stretch be those of the one before
    pure subroutine nothing_changes(stretch)
        type(stretch_type), intent(inout) :: stretch

        stretch%changed = [integer ::]
        stretch%closed = [logical ::]
        if (allocated(stretch%laws)) stretch%laws = stretch%laws(:0)
    end subroutine nothing_changes

    !> Go on to the pieces of the next stretch
    pure subroutine enter_stretch(stretch, pieces)
        type(stretch_type), intent(in) :: stretch
        !> Those on the stretch before in, where not all are kept
        type(pieces_type), intent(inout) :: pieces

        if (allocated(stretch%changed)) then
            pieces%closed(stretch%changed) = stretch%closed
            if (allocated(stretch%laws)) pieces%laws(stretch%changed) = stretch%laws
            pieces%number = pieces%number + size(stretch%changed)
        else
            pieces%closed = stretch%closed
            if (allocated(stretch%laws)) pieces%laws = stretch%laws
            pieces%number = 0
        end if
    end subroutine enter_stretch

    !> Put a stretch to another place, with what it has allocated
    pure subroutine hand_over(from, to)
        type(stretch_type), intent(inout) :: from, to

        call move_alloc(from%changed, to%changed)
        call move_alloc(from%closed, to%closed)
        call move_alloc(from%laws, to%laws)
        call move_alloc(from%pressed, to%pressed)
        call move_alloc(from%reactions, to%reactions)
        call move_alloc(from%along, to%along)
        call move_alloc(from%along_contact, to%along_contact)
        to%whole = from%whole
        to%ends = from%ends
        to%loose = from%loose
        to%leg = from%leg
        to%from = from%from
        to%to = from%to
        to%direction = from%direction
        to%index = from%index
        to%ways = from%ways
        to%skipped = from%skipped
    end subroutine hand_over

    !> Are the laws of all supports the same
    pure function same_laws(a, b) result(they_are)
        type(node_support_type), intent(in) :: a(:), b(:)
        logical :: they_are

        they_are = all(same_law(a, b))
    end function same_laws

    !> Are two laws the same at a breakpoint
    elemental function same_law(a, b) result(they_are)
        type(node_support_type), intent(in) :: a, b
        logical :: they_are

        they_are = .not. (a%contact < b%contact .or. a%contact > b%contact .or. a%force < b%force .or. a%force > b%force &
                          .or. a%stiffness < b%stiffness .or. a%stiffness > b%stiffness &
                          .or. a%before < b%before .or. a%before > b%before)
    end function same_law

end module gapbeam_history_stretch

!> Assembly of foundation laws by points as pieces, at both ends of every piece of the beam.
module gapbeam_assemble_ground_laws
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_layers, only: law_piece_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_tables, only: place_type, place_in_table, follow_table
    use gapbeam_check_foundations, only: find_runs, points_of_law
    implicit none
    private
    public :: law_of_foundation_type, find_laws, make_laws, is_straight

    !> Where the law of a foundation is
    type :: law_of_foundation_type
        !> Points of the law at a place, 0: there is none; first and last of them at all places, among all points
        integer :: points = 0, from = 1, to = 0
        !> The first of its pieces among all, and how often all of them are there: where it varies, for every piece of the beam
        integer :: first = 1, times = 1
        logical :: varies = .false.
    end type law_of_foundation_type

contains

    !> Where the laws are, and their pieces will be
    pure subroutine find_laws(assembled, laws)
        type(assembled_type), intent(in) :: assembled
        !> Of all foundations
        type(law_of_foundation_type), intent(out) :: laws(:)
        integer :: i, next

        next = 1
        call find_runs(assembled%model%ground_law%foundation, laws%from, laws%to)
        do i = 1, size(laws)
            associate (law => laws(i))
                law%points = points_of_law(assembled%model%ground_law(law%from:law%to))
                law%first = next
                law%varies = law%to - law%from + 1 > law%points
                if (law%varies) law%times = assembled%foundation_to(i) - assembled%foundation_from(i)
                next = next + law%points*law%times
            end associate
        end do
    end subroutine find_laws

    !> Pieces of all laws, one for every point: the one that ends there, the last one going on
    pure subroutine make_laws(assembled, laws, error)
        type(assembled_type), intent(inout) :: assembled
        type(law_of_foundation_type), intent(in) :: laws(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer(int64) :: total
        integer :: i, stat

        total = 0
        do i = 1, size(laws)
            total = total + int(laws(i)%points, int64)*laws(i)%times
        end do
        stat = merge(1, 0, total >= huge(i))
        if (stat == 0 .and. .not. allocated(assembled%law_pieces)) allocate (assembled%law_pieces(total), stat=stat)
        do i = 1, size(laws)
            if (stat == 0 .and. laws(i)%points > 0) call make_law(assembled, laws(i), assembled%foundation_from(i), &
                                                                  assembled%foundation_to(i), stat)
        end do
        if (stat /= 0) call no_memory(error)
    end subroutine make_laws

    !> The pieces of one law
    pure subroutine make_law(assembled, law, left, right, stat)
        type(assembled_type), intent(inout) :: assembled
        type(law_of_foundation_type), intent(in) :: law
        !> First and last point of the foundation
        integer, intent(in) :: left, right
        !> Not 0: no memory
        integer, intent(out) :: stat
        real(wp), allocatable :: d(:, :, :), f(:, :, :)
        type(place_type), allocatable :: places(:)
        integer :: i, j, n

        n = law%points
        allocate (d(2, law%times, n), f(2, law%times, n), stat=stat)
        if (stat /= 0) return
        associate (before => size(assembled%model%ground), all_points => assembled%model%ground_law)
            if (law%varies) places = [(place_in_table(assembled, before + i, all_points(i)%x), i=law%from, law%to, law%points)]
        end associate
        associate (points => assembled%model%ground_law(law%from:law%to))
            do i = 1, n
                if (law%varies) then
                    call follow_table(assembled, left, right, places, points(i::n)%displacement, d(:, :, i))
                    call follow_table(assembled, left, right, places, points(i::n)%force, f(:, :, i))
                else
                    d(:, :, i) = points(i)%displacement
                    f(:, :, i) = points(i)%force
                end if
            end do
        end associate
        do j = 1, law%times
            do i = 1, n
                assembled%law_pieces(law%first + (j - 1)*n + i - 1) = piece_between([0.0_wp, d(1, j, :i)], [0.0_wp, d(2, j, :i)], &
                                                                                    [0.0_wp, f(1, j, :i)], [0.0_wp, f(2, j, :i)])
            end do
        end do
    end subroutine make_law

    !> The piece of a law between the last two of some points
    pure function piece_between(d_a, d_b, f_a, f_b) result(piece)
        !> Displacements and forces at both ends of a piece of the beam
        real(wp), intent(in) :: d_a(:), d_b(:), f_a(:), f_b(:)
        type(law_piece_type) :: piece

        associate (n => size(d_a))
            piece%displacement_a = d_a(n - 1)
            piece%displacement_b = d_b(n - 1)
            piece%force_a = f_a(n - 1)
            piece%force_b = f_b(n - 1)
            piece%way_a = d_a(n) - d_a(n - 1)
            piece%way_b = d_b(n) - d_b(n - 1)
            piece%slope_a = (f_a(n) - f_a(n - 1))/piece%way_a
            piece%slope_b = (f_b(n) - f_b(n - 1))/piece%way_b
        end associate
    end function piece_between

    !> Are the displacements at which pieces of a law begin and end the same at both ends, so that slopes are linear in between
    pure function is_straight(pieces)
        type(law_piece_type), intent(in) :: pieces(:)
        logical :: is_straight

        is_straight = .not. any(abs(pieces%displacement_a - pieces%displacement_b) > 0.0_wp &
                                .or. abs(pieces%way_a - pieces%way_b) > 0.0_wp)
    end function is_straight

end module gapbeam_assemble_ground_laws

!> Bounds of the values of supports under a train: where the extremes may be.
!> Stretches of a train's way on which a support may have its largest or smallest reaction, opening, deflection or couple: the line
!> between the values at both ends, moved by h**2/8 of the second derivative (gapbeam_train_columns)
module gapbeam_train_support_bounds
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: train_slack
    use gapbeam_law, only: both
    use gapbeam_scene, only: gapbeam_axial
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type
    use gapbeam_train_columns, only: columns_type, most_columns, value_of_column
    implicit none
    private
    public :: support_bounds_type, new_support_bounds, watch_scheme, bound_supports, mark_stretches

    !> Values at the node of a support that tell its reaction, deflection or couple
    integer, parameter :: force = 1, deflection = 2, couple = 3

    !> What changes of a support in a scheme: which of its four values, and from what
    type :: watch_type
        integer :: support = 0, what = 0, from = 0, node = 0
        real(wp) :: way = 1.0_wp
    end type watch_type

    !> A stretch that may hold an extreme value, which one it is, and how large at most
    type :: kept_type
        integer :: stretch = 0, which(3) = 0
        real(wp) :: bound = 0.0_wp
    end type kept_type

    !> What is known of the extremes
    type :: support_bounds_type
        !> What the scheme at hand lets change
        integer, private :: number = 0
        type(watch_type), allocatable, private :: watches(:)
        !> Values that stay as they are in it, shape (4, nsupport), and supports of which nothing is told here
        logical, allocatable :: stays(:, :), always(:)
        !> Largest (1) and negative smallest (2) values that are reached in the engine's units, shape (2, 4, nsupport); the largest
        !> of all supports
        real(wp), allocatable, private :: reached(:, :, :)
        real(wp), private :: size(4) = 0.0_wp
        integer, private :: count = 0
        type(kept_type), allocatable, private :: kept(:)
    end type support_bounds_type

contains

    !> Room
    subroutine new_support_bounds(assembled, bounds, stat)
        type(assembled_type), intent(in) :: assembled
        type(support_bounds_type), intent(out) :: bounds
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat
        integer :: m

        m = size(assembled%model%supports)
        allocate (bounds%watches(4*m), bounds%stays(4, m), bounds%always(m), bounds%reached(2, 4, m), bounds%kept(256), &
                  stat=stat)
        if (stat /= 0) return
        bounds%reached(:, :, :) = -huge(1.0_wp)
        bounds%always(:) = .false.
    end subroutine new_support_bounds

    !> Find what changes of the supports in a scheme
    subroutine watch_scheme(assembled, closed, columns, bounds)
        type(assembled_type), intent(in) :: assembled
        logical, intent(in) :: closed(:)
        !> Of the scheme
        type(columns_type), intent(in) :: columns
        type(support_bounds_type), intent(inout) :: bounds
        integer :: acting(0:ubound(columns%work%nodes, 1)), j, k, node
        logical :: acts

        acting(:) = 0
        do k = 1, size(bounds%always)
            j = assembled%beam_support(k)
            if (j == 0) cycle
            node = assembled%node_of_point(assembled%support_point(k))
            if (assembled%with_law(k)) then
                acting(node) = acting(node) + 2
            else if (closed(j)) then
                acting(node) = acting(node) + 1
            end if
        end do
        bounds%number = 0
        do k = 1, size(bounds%always)
            bounds%stays(:, k) = .true.
            if (assembled%model%supports(k)%direction == gapbeam_axial) cycle
            j = assembled%beam_support(k)
            node = assembled%node_of_point(assembled%support_point(k))
            ! Who carries what at a node is told by the laws of all of them
            bounds%always(k) = acting(node) > 1 .or. assembled%with_law(k)
            if (bounds%always(k)) then
                bounds%stays(:, k) = .false.
                cycle
            end if
            acts = j > 0
            if (acts) acts = closed(j)
            associate (side => assembled%model%supports(k)%side)
                if (acts) call watch(1, force, 1.0_wp)
                if (side /= both .and. .not. acts) call watch(2, deflection, -real(side, wp))
            end associate
            if (.not. columns%work%nodes(node)%held) call watch(3, deflection, 1.0_wp)
            if (assembled%couple_share(k) > 0.0_wp) call watch(4, couple, 1.0_wp)
        end do

    contains

        !> Watch a value
        subroutine watch(what, from, way)
            integer, intent(in) :: what, from
            real(wp), intent(in) :: way

            bounds%stays(what, k) = .false.
            bounds%number = bounds%number + 1
            bounds%watches(bounds%number) = watch_type(k, what, from, node, way)
        end subroutine watch

    end subroutine watch_scheme

    !> Look at the supports on a stretch
    subroutine bound_supports(track, k, columns, bounds)
        type(track_type), intent(in) :: track
        !> Number of the stretch, and its columns
        integer, intent(in) :: k
        type(columns_type), intent(in) :: columns
        type(support_bounds_type), intent(inout) :: bounds
        real(wp) :: c(most_columns), first, last, rise, most
        integer :: i, n, q

        n = size(track%beam%links)
        do q = 1, bounds%number
            associate (watch => bounds%watches(q), h => columns%length)
                i = watch%node
                select case (watch%from)
                case (force)
                    c(:) = 0.0_wp
                    c(1) = columns%work%loads(i)%shear
                    if (i > 0) then
                        c(:) = c - columns%shear_b(:, i) &
                            - (columns%moment_left(:, i) - columns%moment_right(:, i - 1))*track%beam%links(i)%inverse
                    end if
                    if (i < n) then
                        c(:) = c + columns%shear_a(:, i + 1) &
                            + (columns%moment_left(:, i + 1) - columns%moment_right(:, i))*track%beam%links(i + 1)%inverse
                    end if
                case (deflection)
                    c(:) = watch%way*columns%deflection(:, i)
                case default
                    c(:) = columns%moment_right(:, i) - columns%moment_left(:, i)
                end select
                first = c(1)
                last = value_of_column(c, h)
                rise = h**2/8*(max(2*abs(c(3)), abs(2*c(3) + h*(6*c(4) + 12*h*c(5)))) + 3*h**2*abs(c(5)))
                most = max(abs(first), abs(last)) + rise
                bounds%size(watch%what) = max(bounds%size(watch%what), most)
                associate (reached => bounds%reached(:, watch%what, watch%support), &
                           near => bounds%size(watch%what)*train_slack)
                    reached(1) = max(reached(1), first, last)
                    reached(2) = max(reached(2), -first, -last)
                    most = max(first, last) + rise
                    if (most >= reached(1) - near) call keep(watch, 1)
                    most = -min(first, last) + rise
                    if (most >= reached(2) - near) call keep(watch, 2)
                end associate
            end associate
        end do

    contains

        !> Keep a stretch
        subroutine keep(watch, i)
            type(watch_type), intent(in) :: watch
            integer, intent(in) :: i

            if (bounds%count == size(bounds%kept)) then
                call drop(bounds)
                if (2*bounds%count > size(bounds%kept)) bounds%kept = [bounds%kept, bounds%kept]
            end if
            bounds%count = bounds%count + 1
            bounds%kept(bounds%count) = kept_type(k, [i, watch%what, watch%support], most)
        end subroutine keep

    end subroutine bound_supports

    !> Drop stretches that are no longer in question
    pure subroutine drop(bounds)
        type(support_bounds_type), intent(inout) :: bounds
        integer :: kept, q

        kept = 0
        do q = 1, bounds%count
            associate (one => bounds%kept(q), w => bounds%kept(q)%which)
                if (one%bound < bounds%reached(w(1), w(2), w(3)) - bounds%size(w(2))*train_slack) cycle
                kept = kept + 1
                bounds%kept(kept) = one
            end associate
        end do
        bounds%count = kept
    end subroutine drop

    !> Mark the stretches that may hold an extreme value
    pure subroutine mark_stretches(bounds, wanted)
        type(support_bounds_type), intent(inout) :: bounds
        !> Shape (number of stretches)
        logical, intent(inout) :: wanted(:)

        call drop(bounds)
        wanted(bounds%kept(:bounds%count)%stretch) = .true.
    end subroutine mark_stretches

end module gapbeam_train_support_bounds

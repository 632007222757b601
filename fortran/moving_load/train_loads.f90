!> Loads of a train on the links of a beam at one position.
module gapbeam_train_loads
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: drop_loads_of_link
    use gapbeam_train, only: track_type
    use gapbeam_train_intervals, only: interval_type
    implicit none
    private
    public :: place_train

contains

    !> Put a train on the beam: its loads are the second ones of the links
    subroutine place_train(track, interval, s)
        type(track_type), intent(inout) :: track
        !> The interval, by enter_interval, and a place in it
        type(interval_type), intent(in) :: interval
        real(wp), intent(in) :: s
        integer :: i, j

        do i = 1, track%loaded
            call drop_loads_of_link(track%beam%links(track%with_load(i)), 2)
            track%is_loaded(track%with_load(i)) = .false.
        end do
        track%loaded = 0
        do i = 1, size(track%train%offset)
            if (interval%piece(i) == 0) cycle
            call add_force(interval%piece(i), within(track, interval%piece(i), s + track%train%offset(i)), &
                           scale(track%train%force(i), -track%force_unit))
        end do
        do i = 1, size(track%train%uniform)
            do j = interval%first(i), interval%last(i)
                call add_uniform(j, within(track, j, s + track%train%uniform(i)%from), &
                                 within(track, j, s + track%train%uniform(i)%to), &
                                 scale(track%train%uniform(i)%q, track%length_unit - track%force_unit))
            end do
        end do

    contains

        !> A force in a piece
        subroutine add_force(piece, t, force)
            integer, intent(in) :: piece
            real(wp), intent(in) :: t, force
            real(wp) :: distance, rest

            call note(track%link(piece))
            associate (link => track%beam%links(track%link(piece)))
                distance = track%before(piece) + t
                rest = max(0.0_wp, link%length - distance)
                link%turn_a(2) = link%turn_a(2) + force*value_of_cubic(track%turn_a(:, piece), t)
                link%turn_b(2) = link%turn_b(2) + force*value_of_cubic(track%turn_b(:, piece), t)
                link%shear_a(2) = link%shear_a(2) + force*rest*link%inverse
                link%shear_b(2) = link%shear_b(2) - force*min(1.0_wp, distance*link%inverse)
                link%load_sum(2) = link%load_sum(2) + abs(force)
                link%turn_sum(2) = link%turn_sum(2) + link%bending*abs(force)*distance*rest*link%inverse
            end associate
        end subroutine add_force

        !> A uniform load in a piece from one distance from its left end to another
        subroutine add_uniform(piece, from, to, q)
            integer, intent(in) :: piece
            real(wp), intent(in) :: from, to, q
            real(wp) :: whole, middle

            if (.not. to > from) return
            call note(track%link(piece))
            associate (link => track%beam%links(track%link(piece)))
                whole = q*(to - from)
                middle = track%before(piece) + (from + (to - from)/2)
                link%turn_a(2) = link%turn_a(2) + q*integral(track%turn_a(:, piece), from, to)
                link%turn_b(2) = link%turn_b(2) + q*integral(track%turn_b(:, piece), from, to)
                link%shear_a(2) = link%shear_a(2) + whole*max(0.0_wp, link%length - middle)*link%inverse
                link%shear_b(2) = link%shear_b(2) - whole*min(1.0_wp, middle*link%inverse)
                link%load_sum(2) = link%load_sum(2) + abs(whole)
                link%turn_sum(2) = link%turn_sum(2) + link%bending*abs(whole)*middle
            end associate
        end subroutine add_uniform

        !> Note that a link has loads of the train
        subroutine note(link)
            integer, intent(in) :: link

            if (track%is_loaded(link)) return
            track%is_loaded(link) = .true.
            track%loaded = track%loaded + 1
            track%with_load(track%loaded) = link
        end subroutine note

    end subroutine place_train

    !> Distance of a place from the left end of a piece, in it, in the engine's units
    pure function within(track, piece, x) result(t)
        type(track_type), intent(in) :: track
        integer, intent(in) :: piece
        real(wp), intent(in) :: x
        real(wp) :: t

        t = min(max(scale(x - track%x(piece - 1), -track%length_unit), 0.0_wp), track%length(piece))
    end function within

    !> Value of a cubic
    pure function value_of_cubic(c, t) result(value)
        real(wp), intent(in) :: c(0:3), t
        real(wp) :: value

        value = c(0) + t*(c(1) + t*(c(2) + t*c(3)))
    end function value_of_cubic

    !> Integral of a cubic, as a sum about the middle, where no digits cancel
    pure function integral(c, from, to) result(area)
        real(wp), intent(in) :: c(0:3), from, to
        real(wp) :: area, m, h

        m = from + (to - from)/2
        h = (to - from)/2
        area = 2*h*(value_of_cubic(c, m) + h**2*(c(2) + 3*m*c(3))/3)
    end function integral

end module gapbeam_train_loads

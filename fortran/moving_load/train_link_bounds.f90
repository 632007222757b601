!> Bounds of the fields of each link under a train on a stretch of its way.
!> What its fields are at both ends of the stretch, and how far they can be from the line between (gapbeam_train_bounds).
module gapbeam_train_link_bounds
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type
    use gapbeam_fields, only: softness_of
    use gapbeam_link, only: piece_load_type, combine_loads
    use gapbeam_quantities, only: state_count, derived_count, bending_count, shares_of, with_derived
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type
    use gapbeam_train_intervals, only: interval_type, enter_interval
    use gapbeam_train_cells, only: cells_type, new_cells, find_cells
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_columns, only: columns_type, new_columns, set_scheme, at_distance, value_of_column
    use gapbeam_train_elimination, only: solve_columns
    implicit none
    private
    public :: view_type, link_bounds_type, slopes_type, new_view, enter_stretch, enter_next_interval, bound_link, slopes_in_link, &
        greatest_curvature, greater

    !> Quantities of bending (gapbeam_quantities) in a link at one position: bounds, and values that are there
    type :: link_bounds_type
        real(wp), dimension(bending_count) :: high, low, top, bottom
    end type link_bounds_type

    !> Largest first and second derivatives of the moments and deflections at the ends of a link in the position
    type :: slopes_type
        real(wp) :: moment = 0.0_wp, moment_2 = 0.0_wp, deflection = 0.0_wp, deflection_2 = 0.0_wp
    end type slopes_type

    !> A link as far as its bounds need it: largest flexibilities, loads per length and their slope, imposed curvature
    type :: worst_type
        real(wp) :: flexibility, shear_flexibility, load, slope, curvature
    end type worst_type

    !> What is looked at
    type :: view_type
        type(columns_type) :: columns
        type(cells_type) :: cells
        !> Where the train is, and where it goes next, with the number of that interval
        type(interval_type) :: interval, ahead
        integer :: next = 0
        !> The stretch that is shown, that whose scheme is factored; can anything be seen, and was it factored for this stretch
        integer :: stretch = 0, scheme_of = 0
        logical :: clear = .false., new_scheme = .false.
        !> Positions of the train at its ends
        real(wp) :: ends(2) = 0.0_wp
        !> Largest and negative smallest deflections and rotations that need not be known closely, if they are not above these
        real(wp) :: enough(2, 2) = -huge(1.0_wp)
        !> Loads that stay, shape (npiece)
        type(piece_load_type), allocatable :: loads(:)
        !> Shape (n)
        type(worst_type), allocatable :: worst(:)
        !> Sums of the axles in every link, and of the train's uniform loads there, shape (n)
        real(wp), allocatable :: axles(:), uniform(:)
        !> Does the beam give way in shear anywhere
        logical :: shears = .false.
    end type view_type

contains

    !> Make ready to look
    subroutine new_view(assembled, track, view, stat)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(view_type), intent(out) :: view
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat
        integer :: i, j, n

        n = size(track%beam%links)
        call new_columns(track, view%columns, stat)
        if (stat == 0) call new_cells(track, view%cells, stat)
        if (stat == 0) allocate (view%loads(size(track%link)), view%worst(n), view%axles(n), view%uniform(n), stat=stat)
        if (stat /= 0) return
        view%worst(:) = worst_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        do j = 1, size(track%link)
            view%loads(j) = combine_loads(assembled%dead(j), assembled%live(j), 1.0_wp)
            i = track%link(j)
            associate (worst => view%worst(i), p => assembled%pieces(j), q => view%loads(j))
                worst%flexibility = max(worst%flexibility, p%flexibility)
                worst%shear_flexibility = max(worst%shear_flexibility, p%shear_flexibility)
                worst%load = max(worst%load, abs(q%qa), abs(q%qb))
                worst%slope = max(worst%slope, abs(q%qb - q%qa)/p%length)
                worst%curvature = max(worst%curvature, abs(q%kappa))
            end associate
        end do
        view%shears = any(view%worst%shear_flexibility > 0.0_wp)
    end subroutine new_view

    !> Make a stretch the one at hand
    subroutine enter_stretch(track, traversal, k, view)
        type(track_type), intent(in) :: track
        type(traversal_type), intent(in) :: traversal
        !> Number of a stretch that is solved
        integer, intent(in) :: k
        type(view_type), intent(inout) :: view
        logical :: same
        integer :: c

        if (view%stretch == k) return
        same = view%scheme_of > 0
        if (same) same = all(traversal%closed(:, view%scheme_of) .eqv. traversal%closed(:, k))
        view%new_scheme = .not. same
        if (.not. same) call set_scheme(track%beam, traversal%closed(:, k), view%columns)
        view%scheme_of = k
        view%stretch = k
        view%ends(:) = [traversal%from(k), traversal%to(k)]
        view%clear = view%columns%usable
        if (.not. view%clear) return
        if (view%next == traversal%interval(k)) then
            view%interval = view%ahead
        else
            call enter_interval(track, traversal%intervals(traversal%interval(k)), view%interval)
        end if
        call find_cells(track, view%interval, view%cells)
        call solve_columns(track, view%interval, traversal%from(k), traversal%to(k), view%columns)
        view%clear = view%columns%finite
        view%axles(:) = 0.0_wp
        view%uniform(:) = 0.0_wp
        associate (cells => view%cells)
            do c = 1, cells%number
                associate (cell => cells%cells(c), i => track%link(cells%cells(c)%piece))
                    if (cell%right > 0) view%axles(i) = view%axles(i) + abs(cells%force(cell%right))
                end associate
            end do
        end associate
        do c = 1, size(track%train%uniform)
            associate (first => view%interval%first(c), last => view%interval%last(c), &
                       q => track%train%uniform(c)%q*view%columns%to_force/view%columns%to_length)
                if (first > last) cycle
                associate (links => view%uniform(track%link(first):track%link(last)))
                    links(:) = links + abs(q)
                end associate
            end associate
        end do
    end subroutine enter_stretch

    !> Enter the interval that comes next
    subroutine enter_next_interval(track, traversal, r, view)
        type(track_type), intent(in) :: track
        type(traversal_type), intent(in) :: traversal
        !> Number of the interval
        integer, intent(in) :: r
        type(view_type), intent(inout) :: view

        call enter_interval(track, traversal%intervals(r), view%ahead)
        view%next = r
    end subroutine enter_next_interval

    !> Bound the fields of a link at a position in the stretch
    subroutine bound_link(assembled, track, view, i, share, at_link, starts)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(view_type), intent(in) :: view
        !> Number of the link, and the position as a share of the stretch
        integer, intent(in) :: i
        real(wp), intent(in) :: share
        type(link_bounds_type), intent(out) :: at_link
        !> Fields at the left ends of all cells of the beam: those of the link are put there
        type(field_type), intent(inout), optional :: starts(:)
        real(wp) :: a, b, wa, wb, w, r, m, v, w1, r1, m1, v1, h, s, t, t1, l, qa, slope, most, rest, d, d1
        integer :: c, first

        s = view%ends(1) + share*(view%ends(2) - view%ends(1))
        if (share >= 1.0_wp) s = view%ends(2)
        associate (columns => view%columns, link => track%beam%links(i))
            h = share*columns%length
            a = value_of_column(columns%moment_right(:, i - 1), h)
            b = value_of_column(columns%moment_left(:, i), h)
            wa = value_of_column(columns%deflection(:, i - 1), h)
            wb = value_of_column(columns%deflection(:, i), h)
            w = wa
            m = a
            r = (wb - wa)*link%inverse + link%faa*a + link%fab*b + (link%turn_a(1) + value_of_column(columns%turn_a(:, i), h))
            v = (b - a)*link%inverse + (link%shear_a(1) + value_of_column(columns%shear_a(:, i), h))
        end associate
        at_link%high(:) = -huge(1.0_wp)
        at_link%low(:) = huge(1.0_wp)
        at_link%top(:) = -huge(1.0_wp)
        at_link%bottom(:) = huge(1.0_wp)
        first = 1
        if (i > 1) first = view%cells%last(i - 1) + 1
        t = 0.0_wp
        do c = first, view%cells%last(i)
            associate (cell => view%cells%cells(c), p => assembled%pieces(view%cells%cells(c)%piece), &
                       load => view%loads(view%cells%cells(c)%piece))
                if (cell%left > 0) then
                    v = v - view%cells%force(cell%left)
                else
                    t = 0.0_wp
                    if (c > first) then
                        v = v - view%loads(cell%piece - 1)%force
                        m = m + view%loads(cell%piece - 1)%couple
                    end if
                end if
                t1 = p%length
                if (cell%right > 0) t1 = at_distance(track, view%columns, cell%piece, s + view%cells%offset(cell%right))
                l = max(0.0_wp, t1 - t)
                slope = (load%qb - load%qa)/p%length
                qa = load%qa + slope*t + cell%q
                if (present(starts)) starts(c) = field_type(w, r, m, v)
                associate (f => p%flexibility, g => p%shear_flexibility, kappa => load%kappa)
                    m1 = m + l*(v - l*(qa/2 + l*slope/6))
                    v1 = v - l*(qa + l*slope/2)
                    r1 = r + l*(kappa - f*(m + l*(v/2 - l*(qa/6 + l*slope/24))))
                    w1 = w + l*(r + l*(kappa/2 - f*(m/2 + l*(v/6 - l*(qa/24 + l*slope/120))))) + g*(m1 - m)
                    ! Hermite's cubics by their Bernstein coefficients, and what is left
                    most = max(abs(qa), abs(qa + l*slope))
                    d = l*(r + g*v)/3
                    d1 = l*(r1 + g*v1)/3
                    rest = f*most*l**4/384
                    call bound_cubic([w, w + d, w1 - d1, w1], rest, view%enough(:, 1), &
                                     at_link%high(1), at_link%low(1), at_link%top(1), at_link%bottom(1))
                    d = l*(kappa - f*m)/3
                    d1 = l*(kappa - f*m1)/3
                    rest = f*abs(slope)*l**4/384
                    call bound_cubic([r, r + d, r1 - d1, r1], rest, view%enough(:, 2), &
                                     at_link%high(2), at_link%low(2), at_link%top(2), at_link%bottom(2))
                end associate
                rest = 0.0_wp
                if (changes(v, v1) .or. changes(qa, qa + l*slope)) rest = most*l**2/8
                at_link%high(3) = max(at_link%high(3), m + rest, m1 + rest)
                at_link%low(3) = min(at_link%low(3), m - rest, m1 - rest)
                rest = 0.0_wp
                if (changes(qa, qa + l*slope)) rest = most*l
                at_link%high(4) = max(at_link%high(4), v + rest, v1 + rest)
                at_link%low(4) = min(at_link%low(4), v - rest, v1 - rest)
                if (l > 0.0_wp) then
                    at_link%top(3) = max(at_link%top(3), m, m1)
                    at_link%bottom(3) = min(at_link%bottom(3), m, m1)
                    at_link%top(4) = max(at_link%top(4), v, v1)
                    at_link%bottom(4) = min(at_link%bottom(4), v, v1)
                end if
                call bound_derived(softness_of(p), load%kappa, [w, r, m, v], [w1, r1, m1, v1], abs(slope))
            end associate
            t = t1
            w = w1
            r = r1
            m = m1
            v = v1
        end do

    contains

        !> Bounds of the derived quantities in a cell: no farther from the chord of their ends than length**2/8 times the largest
        !> second derivative
        subroutine bound_derived(softness, kappa, left, right, steep)
            !> 1/EI and 1/GA; imposed curvature; deflection, rotation, moment, shear at the ends of the cell; slope of the load
            real(wp), intent(in) :: softness(2), kappa, left(state_count), right(state_count), steep
            real(wp) :: bend(state_count), share(state_count + 1, derived_count), first(bending_count), last(bending_count), rise
            integer :: d

            bend(4) = steep
            bend(3) = most
            bend(2) = softness(1)*(max(abs(left(4)), abs(right(4))) + l**2/8*steep)
            bend(1) = abs(kappa) + softness(1)*(max(abs(left(3)), abs(right(3))) + l**2/8*most) + softness(2)*most
            share(:, :) = shares_of(softness)
            first(:) = with_derived(left, softness, kappa)
            last(:) = with_derived(right, softness, kappa)
            do d = state_count + 1, bending_count
                rise = l**2/8*dot_product(bend, abs(share(1:state_count, d - state_count)))
                at_link%high(d) = max(at_link%high(d), max(first(d), last(d)) + rise)
                at_link%low(d) = min(at_link%low(d), min(first(d), last(d)) - rise)
                if (.not. l > 0.0_wp) cycle
                at_link%top(d) = max(at_link%top(d), first(d), last(d))
                at_link%bottom(d) = min(at_link%bottom(d), first(d), last(d))
            end do
        end subroutine bound_derived

        !> Bounds of what is nearly a cubic, and what it reaches
        pure subroutine bound_cubic(b, rest, enough, high, low, top, bottom)
            !> Its Bernstein coefficients, how far from it the values may be, and up to where they need not be known closely
            real(wp), intent(in) :: b(0:3), rest, enough(2)
            real(wp), intent(inout) :: high, low, top, bottom
            real(wp) :: most, least, root, t(2), value
            integer :: k

            most = max(b(0), b(3))
            least = min(b(0), b(3))
            if (max(most, b(1), b(2)) < enough(1) .and. -min(least, b(1), b(2)) < enough(2)) then
                high = max(high, most + rest, b(1) + rest, b(2) + rest)
                low = min(low, least - rest, b(1) - rest, b(2) - rest)
                return
            end if
            if (max(b(1), b(2)) > most .or. min(b(1), b(2)) < least) then
                associate (d0 => b(1) - b(0), d1 => b(2) - b(1), d2 => b(3) - b(2))
                    ! Where the slope is zero: t/(1 - t) is a root of d0 + 2 d1 x + d2 x**2
                    root = d1**2 - d0*d2
                    if (root >= 0.0_wp) then
                        root = sqrt(root)
                        root = -(d1 + sign(root, d1))
                        t(:) = 0.0_wp
                        if (abs(root + d2) > 0.0_wp) t(1) = root/(root + d2)
                        if (abs(root + d0) > 0.0_wp) t(2) = d0/(root + d0)
                        do k = 1, 2
                            if (.not. (t(k) > 0.0_wp .and. t(k) < 1.0_wp)) cycle
                            associate (u => t(k), z => 1 - t(k))
                                value = z**3*b(0) + 3*u*z*(z*b(1) + u*b(2)) + u**3*b(3)
                            end associate
                            most = max(most, value)
                            least = min(least, value)
                        end do
                    end if
                end associate
            end if
            high = max(high, most + rest)
            low = min(low, least - rest)
            if (.not. l > 0.0_wp) return
            top = max(top, most - rest)
            bottom = min(bottom, least + rest)
        end subroutine bound_cubic

        !> Do two numbers differ in sign
        pure function changes(x, y)
            real(wp), intent(in) :: x, y
            logical :: changes

            changes = min(x, y) < 0.0_wp .and. max(x, y) > 0.0_wp
        end function changes

    end subroutine bound_link

    !> Derivatives of the values at the ends of a link on the stretch
    pure function slopes_in_link(view, i) result(slopes)
        type(view_type), intent(in) :: view
        integer, intent(in) :: i
        type(slopes_type) :: slopes

        associate (columns => view%columns, h => view%columns%length)
            slopes%moment_2 = max(second(columns%moment_right(:, i - 1)), second(columns%moment_left(:, i)))
            slopes%moment = max(abs(columns%moment_right(2, i - 1)), abs(columns%moment_left(2, i))) + h*slopes%moment_2
            if (columns%work%nodes(i - 1)%held .and. columns%work%nodes(i)%held) return
            slopes%deflection_2 = max(second(columns%deflection(:, i - 1)), second(columns%deflection(:, i)))
            slopes%deflection = max(abs(columns%deflection(2, i - 1)), abs(columns%deflection(2, i))) + h*slopes%deflection_2
        end associate

    contains

        !> Bound of the second derivative
        pure function second(c)
            real(wp), intent(in) :: c(:)
            real(wp) :: second

            associate (h => view%columns%length)
                second = max(2*abs(c(3)), abs(2*c(3) + h*(6*c(4) + 12*h*c(5)))) + 3*h**2*abs(c(5))
            end associate
        end function second

    end function slopes_in_link

    !> The larger ones
    elemental function greater(a, b) result(slopes)
        type(slopes_type), intent(in) :: a, b
        type(slopes_type) :: slopes

        slopes = slopes_type(max(a%moment, b%moment), max(a%moment_2, b%moment_2), max(a%deflection, b%deflection), &
                             max(a%deflection_2, b%deflection_2))
    end function greater

    !> Bounds of the second derivatives in the position of all fields in a link, in cells at a fixed share of their length, so on a
    !> place that moves with a speed of 0 to 1: F_ss + 2 F_xs + F_xx at most; at a place that stays F_ss. In the simple bar an axle
    !> at y makes the deflection int f m_x m_y + int g m_x' m_y' at x (m_x the moment under a unit force at x); its derivatives in
    !> x and y have the bounds used here, those of moment and shear are read off m_y
    pure function greatest_curvature(track, view, i, slopes, speed, h, high, low) result(k)
        type(track_type), intent(in) :: track
        !> On any stretch on which the same axles are in the link
        type(view_type), intent(in) :: view
        integer, intent(in) :: i
        type(slopes_type), intent(in) :: slopes
        !> Greatest speed, length of the way, and bounds of all fields at both ends of it
        real(wp), intent(in) :: speed, h, high(bending_count), low(bending_count)
        !> Of the quantities of bending; shares of derived ones are greatest where 1/EI and 1/GA are
        real(wp) :: k(bending_count)
        real(wp) :: moment, shear, moment_s, slope_s, rotation_ss, deflection_ss, share(state_count + 1, derived_count)

        associate (link => track%beam%links(i), l => track%beam%links(i)%length, n => track%beam%links(i)%inverse, &
                   f => view%worst(i)%flexibility, g => view%worst(i)%shear_flexibility, axles => view%axles(i), &
                   q => view%uniform(i), worst => view%worst(i), m1 => slopes%moment, m2 => slopes%moment_2, &
                   w1 => slopes%deflection, w2 => slopes%deflection_2)
            k(4) = 2*m2*n + 2*q*n + speed*worst%slope
            k(3) = m2 + 2*q + speed*(2*(2*m1*n + axles*n + q) + worst%load + q)
            ! What the fields can be on the way
            shear = max(abs(high(4)), abs(low(4))) + h**2/8*k(4)
            moment = max(abs(high(3)), abs(low(3))) + h**2/8*k(3)
            moment_s = m1 + axles + q*l/2
            slope_s = 2*w1*n + (f*l/2 + 4*g*n)*m1 + axles*(f*l/3 + 2*g*n) + 2*q*(f*l**2/8 + 2*g)
            rotation_ss = 2*w2*n + (f*l/2 + 4*g*n)*m2 + f*axles + 2*q*(f*l/3 + 2*g*n) + 2*g*n*(m2 + q)
            deflection_ss = w2 + (f*l**2/8 + 2*g)*m2 + axles*f*l/4 + 2*q*(f*l**2/8 + 2*g)
            k(2) = rotation_ss + speed*(2*f*moment_s + f*shear)
            k(1) = deflection_ss + speed*(2*slope_s + f*moment + worst%curvature + g*(worst%load + q))
            share(:, :) = shares_of([f, g])
            k(state_count + 1:) = matmul(k(1:state_count), abs(share(1:state_count, :)))
        end associate
    end function greatest_curvature

end module gapbeam_train_link_bounds

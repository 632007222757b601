!> Stretches whose EI or GA is a power of a depth that is linear along them: flexibilities, turning by loads, fields.
!>
!> With the depth h(t) = (1 - t) + ratio t relative to that at the left end, 1/EI = f/h**power. All integrals are those of Gauss on
!> intervals in which the depth at most doubles: the pole of 1/h is then three half lengths away, and n points leave (3 + sqrt(8))
!> **(-2n), less than rounding. Terms keep the sign of the moment, so nothing cancels that does not in closed forms, whose
!> logarithms lose digits where the taper is slight (docs/method.md 2). Shares of the length are counted from the shallow end, where
!> the stretch is soft: there they have all their digits.
module gapbeam_taper
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: most_deepening
    use gapbeam_piece, only: piece_type, piece_load_type, is_tapered
    use gapbeam_element, only: field_type, fields_at
    implicit none
    private
    public :: depth_ratio, depth_ratios, softness_at, part_of_piece, mean_softness, find_softness, turn_ends, fields_in_piece
    public :: steps_of_taper, share_of_taper

    !> Left half of the points of Gauss's formula with 28 points from 0 to 1, and their weights: 3e-43 is left of a function whose
    !> pole is as near as it gets. Doubles could do with 16 (6e-25)
    integer, parameter :: half = 14, number_of_points = 2*half
    real(wp), parameter :: place(half) = [ &
        0.00177875121302277502478180475834450412_wp, 0.00934841731456362315272002709608486178_wp, &
        0.0228703596855309013729490801473922055_wp, 0.0421834868039339630651552883350364268_wp, &
        0.0670537387128024755288727163101565978_wp, 0.0971793145414104142760570222873611707_wp, &
        0.132194560993184113985927744853732816_wp, 0.171674452980567519390050911746628589_wp, &
        0.215139764094299140345998358321784533_wp, 0.262062887522440869482794076166282979_wp, &
        0.311874241955460644889321395221956509_wp, 0.363969186182410961161586821937115133_wp, &
        0.417715358933309614359264111054417271_wp, 0.472460355057982864786741736329060011_wp]
    real(wp), parameter :: weight(half) = [ &
        0.00456214129654725886940807696147585312_wp, 0.0105660562963856298757501904966327172_wp, &
        0.0164507138911521899888154095852660230_wp, 0.0221364673795021139197939388266036953_wp, &
        0.0275536728378583727157414591134727956_wp, 0.0326364619834997978966987833877523182_wp, &
        0.0373231071172843895119659435865110190_wp, 0.0415567086144506091951982491221662399_wp, &
        0.0452858721965164204710930156683920649_wp, 0.0484653289989649579252445030477203009_wp, &
        0.0510564837890303849071083192528560675_wp, 0.0530278829614232089552082184984054144_wp, &
        0.0543555961291470676267857596518366839_wp, 0.0550235065082375981411881328009088070_wp]
    real(wp), parameter :: places(number_of_points) = [place, 1 - place(half:1:-1)], &
        shares(number_of_points) = [weight, weight(half:1:-1)]

contains

    !> Depth at the right end relative to that at the left
    elemental function depth_ratio(flexibility, flexibility_to, power) result(ratio)
        !> Reciprocals of the stiffness at both ends, above 0, and its power of the depth; 0: constant
        real(wp), intent(in) :: flexibility, flexibility_to
        integer, intent(in) :: power
        real(wp) :: ratio

        ratio = 1.0_wp
        if (power > 0) ratio = (flexibility/flexibility_to)**(1/real(power, wp))
    end function depth_ratio

    !> 1/EI and 1/GA of a section
    pure function softness_at(piece, distance) result(softness)
        type(piece_type), intent(in) :: piece
        !> From the left end
        real(wp), intent(in) :: distance
        real(wp) :: softness(2)

        softness(:) = softness_of([piece%flexibility, piece%shear_flexibility], depth_ratios(piece), &
                                  [piece%power, piece%shear_power], distance/piece%length)
    end function softness_at

    !> Depths at the right end relative to those at the left: of EI, of GA
    pure function depth_ratios(piece) result(ratios)
        type(piece_type), intent(in) :: piece
        real(wp) :: ratios(2)

        ratios(:) = depth_ratio([piece%flexibility, piece%shear_flexibility], &
                                [piece%flexibility_to, piece%shear_flexibility_to], [piece%power, piece%shear_power])
    end function depth_ratios

    !> What of a piece lies between two places
    pure function part_of_piece(piece, from, to) result(part)
        type(piece_type), intent(in) :: piece
        !> From its left end
        real(wp), intent(in) :: from, to
        type(piece_type) :: part
        real(wp) :: softness(2)

        part = piece
        part%length = to - from
        if (.not. is_tapered(piece)) return
        softness(:) = softness_at(piece, from)
        part%flexibility = softness(1)
        part%shear_flexibility = softness(2)
        softness(:) = softness_at(piece, to)
        part%flexibility_to = softness(1)
        part%shear_flexibility_to = softness(2)
    end function part_of_piece

    !> The reciprocal of a stiffness at a share t of the length
    elemental function softness_of(flexibility, ratio, power, t) result(softness)
        real(wp), intent(in) :: flexibility, ratio, t
        integer, intent(in) :: power
        real(wp) :: softness

        softness = flexibility
        if (power > 0) softness = flexibility/((1 - t) + ratio*t)**power
    end function softness_of

    !> Mean of the reciprocal of a stiffness from the left end to a share of the length
    pure function mean_softness(flexibility, flexibility_to, power, share) result(mean)
        real(wp), intent(in) :: flexibility, flexibility_to
        integer, intent(in) :: power
        !> Above 0, 1: all of the length
        real(wp), intent(in) :: share
        real(wp) :: mean
        real(wp), dimension(number_of_points) :: t, rest, soft
        real(wp) :: ratio
        integer :: k

        mean = flexibility
        if (power == 0) return
        ratio = depth_ratio(flexibility, flexibility_to, power)
        mean = 0.0_wp
        do k = 1, intervals_of(ratio, share)
            call soften(flexibility, ratio, power, share, k, t, rest, soft)
            mean = mean + sum(soft)
        end do
        mean = mean/share
    end function mean_softness

    !> int 1/EI, the distance of its centroid from the left end, its mean squared distance from there, int 1/GA
    pure subroutine find_softness(piece, bending, centre, spread, slip)
        type(piece_type), intent(in) :: piece
        real(wp), intent(out) :: bending, centre, spread, slip
        real(wp), dimension(number_of_points) :: t, rest, soft, way
        real(wp) :: ratio
        integer :: k, round

        bending = piece%flexibility*piece%length
        centre = piece%length/2
        spread = piece%length**2/12
        slip = piece%shear_flexibility*piece%length
        if (piece%power > 0) then
            ratio = depth_ratio(piece%flexibility, piece%flexibility_to, piece%power)
            bending = 0.0_wp
            centre = 0.0_wp
            spread = 0.0_wp
            do round = 1, 2
                do k = 1, intervals_of(ratio, 1.0_wp)
                    call soften(piece%flexibility, ratio, piece%power, 1.0_wp, k, t, rest, soft)
                    way(:) = merge(t, rest, ratio >= 1.0_wp)
                    if (round == 1) then
                        bending = bending + sum(soft)
                        centre = centre + sum(soft*way)
                    else
                        spread = spread + sum(soft*(way - centre)**2)
                    end if
                end do
                if (round == 1) centre = centre/bending
            end do
            spread = spread/bending*piece%length**2
            centre = merge(centre, 1 - centre, ratio >= 1.0_wp)*piece%length
            bending = bending*piece%length
        end if
        if (piece%shear_power > 0) slip = piece%length*mean_softness(piece%shear_flexibility, piece%shear_flexibility_to, &
                                                                      piece%shear_power, 1.0_wp)
    end subroutine find_softness

    !> int (1 - t) M/EI ds, int t M/EI ds and int V/GA ds of a piece with given moments at its ends
    pure subroutine turn_ends(piece, m0, m1, qa, qb, left, right, slip)
        type(piece_type), intent(in) :: piece
        !> Moments at its ends, and load per length there
        real(wp), intent(in) :: m0, m1, qa, qb
        real(wp), intent(out) :: left, right, slip
        real(wp), dimension(number_of_points) :: t, rest, soft
        real(wp) :: ratio
        integer :: k

        associate (l => piece%length)
            left = 0.0_wp
            right = 0.0_wp
            ratio = depth_ratio(piece%flexibility, piece%flexibility_to, piece%power)
            do k = 1, intervals_of(ratio, 1.0_wp)
                call soften(piece%flexibility, ratio, piece%power, 1.0_wp, k, t, rest, soft)
                ! The moment of the simple bar under a linear load has one sign wherever the load has
                soft(:) = soft*((m0*rest + m1*t) + l**2*t*rest*(qa*(1 + rest) + qb*(1 + t))/6)
                left = left + l*sum(soft*rest)
                right = right + l*sum(soft*t)
            end do
            slip = piece%shear_flexibility*(m1 - m0)
            if (piece%shear_power == 0) return
            slip = 0.0_wp
            ratio = depth_ratio(piece%shear_flexibility, piece%shear_flexibility_to, piece%shear_power)
            do k = 1, intervals_of(ratio, 1.0_wp)
                call soften(piece%shear_flexibility, ratio, piece%shear_power, 1.0_wp, k, t, rest, soft)
                slip = slip + sum(soft*((m1 - m0) + l**2*(qa*(3*rest**2 - 1) + qb*(1 - 3*t**2))/6))
            end do
        end associate
    end subroutine turn_ends

    !> Fields inside a piece, tapered or not, from the fields at its left end
    pure function fields_in_piece(start, s, piece, load) result(fields)
        !> Fields just right of its left end
        type(field_type), intent(in) :: start
        !> Distance from there, 0..length
        real(wp), intent(in) :: s
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        type(field_type) :: fields, here
        real(wp), dimension(number_of_points) :: t, rest, soft, ahead
        real(wp) :: ratio, share
        integer :: k, i

        ! Statics, the imposed curvature, and what is not tapered
        fields = fields_at(start, s, piece%length, merge(0.0_wp, piece%flexibility, piece%power > 0), &
                           merge(0.0_wp, piece%shear_flexibility, piece%shear_power > 0), load%qa, load%qb, load%kappa)
        if (abs(load%rise) > 0.0_wp) then
            share = s/piece%length
            fields%rotation = fields%rotation + s*(share*load%rise/2)
            fields%deflection = fields%deflection + s*(s*(share*load%rise/6))
        end if
        if (.not. (is_tapered(piece) .and. s > 0.0_wp)) return
        share = s/piece%length
        if (piece%power > 0) then
            ratio = depth_ratio(piece%flexibility, piece%flexibility_to, piece%power)
            do k = 1, intervals_of(ratio, share)
                call soften(piece%flexibility, ratio, piece%power, share, k, t, rest, soft)
                ahead(:) = merge(share - t, rest - (1 - share), ratio >= 1.0_wp)
                do i = 1, size(t)
                    here = inside(t(i))
                    fields%rotation = fields%rotation - piece%length*soft(i)*here%moment
                    fields%deflection = fields%deflection - piece%length**2*soft(i)*ahead(i)*here%moment
                end do
            end do
        end if
        if (piece%shear_power > 0) then
            ratio = depth_ratio(piece%shear_flexibility, piece%shear_flexibility_to, piece%shear_power)
            do k = 1, intervals_of(ratio, share)
                call soften(piece%shear_flexibility, ratio, piece%shear_power, share, k, t, rest, soft)
                do i = 1, size(t)
                    here = inside(t(i))
                    fields%deflection = fields%deflection + piece%length*soft(i)*here%shear
                end do
            end do
        end if

    contains

        !> Moment and shear at a share of the length
        pure function inside(t) result(here)
            real(wp), intent(in) :: t
            type(field_type) :: here

            here = fields_at(start, t*piece%length, piece%length, 0.0_wp, 0.0_wp, load%qa, load%qb, 0.0_wp)
        end function inside

    end function fields_in_piece

    !> Into how many steps a piece is cut so that its depths change little on each
    pure function steps_of_taper(piece) result(steps)
        type(piece_type), intent(in) :: piece
        integer :: steps

        steps = max(1, ceiling(sum(abs(log(grown_and_fallen(piece))))/log(most_deepening)))
    end function steps_of_taper

    !> Share of the length at which the depths have changed by a part of their whole change: by equal factors on equal parts
    pure function share_of_taper(piece, part) result(t)
        !> Of more than one step
        type(piece_type), intent(in) :: piece
        !> 0..1
        real(wp), intent(in) :: part
        real(wp) :: t, ratio(2), factor

        ! Where one depth grows and the other falls, their quotient is what changes
        ratio(:) = grown_and_fallen(piece)
        factor = (ratio(1)/ratio(2))**part
        t = (factor - 1)/((ratio(1) - 1) + factor*(1 - ratio(2)))
    end function share_of_taper

    !> Ratio of the depth that grows more, 1 or more, and of the one that falls more, 1 or less
    pure function grown_and_fallen(piece) result(ratio)
        type(piece_type), intent(in) :: piece
        real(wp) :: ratio(2), ratios(2)

        ratios(:) = depth_ratios(piece)
        ratio(:) = [max(1.0_wp, maxval(ratios)), min(1.0_wp, minval(ratios))]
    end function grown_and_fallen

    !> Intervals in each of which the depth at most doubles or halves
    pure function intervals_of(ratio, share) result(number)
        !> Depth at the right end of the piece relative to that at the left, and the share of the length that is looked at
        real(wp), intent(in) :: ratio, share
        integer :: number

        number = max(1, ceiling(abs(log((1 - share) + ratio*share))/log(2.0_wp)))
    end function intervals_of

    !> Gauss's points of the k-th of these intervals, and weights times the reciprocal of the stiffness there
    pure subroutine soften(flexibility, ratio, power, share, k, t, rest, soft)
        !> At the left end; depth at the right one; power of the depth
        real(wp), intent(in) :: flexibility, ratio
        integer, intent(in) :: power
        !> Of the length that is looked at
        real(wp), intent(in) :: share
        integer, intent(in) :: k
        !> Shares of the length from both ends, and weights, which sum to share if all softness is 1, shape (number_of_points)
        real(wp), intent(out) :: t(:), rest(:), soft(:)
        real(wp) :: low, rise, first, last, from, to
        integer :: number

        number = intervals_of(ratio, share)
        low = min(1.0_wp, ratio)
        rise = abs(ratio - 1)
        first = merge(0.0_wp, 1 - share, ratio >= 1.0_wp)
        last = merge(share, 1.0_wp, ratio >= 1.0_wp)
        from = border(k - 1)
        to = border(k)
        t(:) = from + (to - from)*places
        soft(:) = flexibility*((to - from)*shares)/(low + rise*t)**power
        rest(:) = 1 - t
        if (ratio >= 1.0_wp) return
        rest(:) = t
        t(:) = 1 - rest

    contains

        !> Where the depth has grown by as many equal factors, from the shallow end
        pure function border(j) result(way)
            integer, intent(in) :: j
            real(wp) :: way, depth

            way = merge(first, last, j == 0)
            if (j == 0 .or. j == number) return
            ! With more than one the depth doubles: ratio is nowhere near 1
            depth = low + rise*first
            way = (depth*((low + rise*last)/depth)**(real(j, wp)/number) - low)/rise
        end function border

    end subroutine soften

end module gapbeam_taper

!> Integrals of smooth functions to rounding by Gauss's formulas on panels.
!> Stroud, Secrest, Gaussian Quadrature Formulas, 1966.
module gapbeam_quadrature
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_panels
    implicit none
    private
    public :: panels_type, cut_into_panels, points_of, most_points

    !> Points of the formulas. From 0 to 1 n of them leave f**(2n) (n!)**4/((2n + 1)((2n)!)**3): nothing but rounding up to this |r|
    !> of a solution of the fourth derivative = r**4 f, also times x and a modulus that is linear in x, which take a derivative each
    integer, parameter :: formulas = 6, points_in(formulas) = [4, 6, 8, 10, 12, 16], most_points = 16
    real(wp), parameter :: reach(formulas) = [0.005_wp, 0.3_wp, 2.3_wp, 5.5_wp, 9.0_wp, 15.0_wp]
    !> The points left of the middle and their weights, formula by formula
    integer, parameter :: before(formulas) = [0, 2, 5, 9, 14, 20]
    real(wp), parameter :: place(28) = [ &
        0.069431844202973712388_wp, 0.33000947820757186760_wp, &
        0.033765242898423986094_wp, 0.16939530676686774317_wp, 0.38069040695840154568_wp, &
        0.019855071751231884158_wp, 0.10166676129318663020_wp, 0.23723379504183550709_wp, 0.40828267875217509753_wp, &
        0.013046735741414139961_wp, 0.067468316655507744634_wp, 0.16029521585048779688_wp, 0.28330230293537640460_wp, &
        0.42556283050918439456_wp, &
        0.0092196828766403746547_wp, 0.047941371814762571661_wp, 0.11504866290284765648_wp, 0.20634102285669127635_wp, &
        0.31608425050090990312_wp, 0.43738329574426554226_wp, &
        0.0052995325041750337019_wp, 0.027712488463383711961_wp, 0.067184398806084128060_wp, 0.12229779582249848305_wp, &
        0.19106187779867812578_wp, 0.27099161117138630683_wp, 0.35919822461037054338_wp, 0.45249374508118127991_wp], &
        share(28) = [ &
        0.17392742256872692869_wp, 0.32607257743127307131_wp, &
        0.085662246189585172520_wp, 0.18038078652406930378_wp, 0.23395696728634552369_wp, &
        0.050614268145188129576_wp, 0.11119051722668723527_wp, 0.15685332293894364367_wp, 0.18134189168918099148_wp, &
        0.033335672154344068797_wp, 0.074725674575290296573_wp, 0.10954318125799102200_wp, 0.13463335965499817755_wp, &
        0.14776211235737643509_wp, &
        0.023587668193255913597_wp, 0.053469662997659215480_wp, 0.080039164271673113167_wp, 0.10158371336153296087_wp, &
        0.11674626826917740438_wp, 0.12457352290670139250_wp, &
        0.013576229705877047426_wp, 0.031126761969323946431_wp, 0.047579255841246392405_wp, 0.062314485627766936026_wp, &
        0.074797994408288366041_wp, 0.084578259697501269095_wp, 0.091301707522461794433_wp, 0.094725305227534248143_wp]

    !> Panels of 0..1
    type :: panels_type
        private
        integer, public :: number = 1
        !> The formula of the only one
        integer :: one = 1
        !> The ends of several, and the formula on each
        real(wp), allocatable :: border(:)
        integer, allocatable :: formula(:)
    end type panels_type

contains

    !> Cut 0..1 so that what fades like exp(-r x) or exp(-r (1 - x)) is integrated to rounding, and polynomials to degree 7
    pure subroutine cut_into_panels(rate, fade, panels)
        !> |r| and its real part, of each of them
        real(wp), intent(in) :: rate(:), fade(:)
        type(panels_type), intent(out) :: panels
        real(wp) :: at, width
        integer :: n

        if (maxval(rate) <= reach(formulas)) then
            panels%one = 1 + count(maxval(rate) > reach)
            return
        end if
        allocate (panels%border(0:2*most_panels), panels%formula(2*most_panels))
        panels%border(0) = 0.0_wp
        at = 0.0_wp
        n = 0
        do while (at < 0.5_wp .and. n < most_panels)
            width = minval(reach(formulas)*exp(min(fade*at/(2*most_points), 64.0_wp))/rate)
            n = n + 1
            panels%border(n) = min(at + width, 0.5_wp)
            if (n == most_panels) panels%border(n) = 0.5_wp
            panels%formula(n) = formula_for(panels%border(n) - at)
            at = panels%border(n)
        end do
        panels%number = 2*n
        panels%border(2*n:n + 1:-1) = 1 - panels%border(0:n - 1)
        panels%formula(2*n:n + 1:-1) = panels%formula(1:n)

    contains

        !> The formula with the fewest points that do for a panel
        pure function formula_for(length) result(k)
            real(wp), intent(in) :: length
            integer :: k

            do k = 1, formulas - 1
                if (all(rate*length*exp(-min(fade*at/(2*points_in(k)), 256.0_wp)) <= reach(k))) return
            end do
        end function formula_for

    end subroutine cut_into_panels

    !> Points and weights of a panel
    pure subroutine points_of(panels, panel, number, points, weights)
        type(panels_type), intent(in) :: panels
        integer, intent(in) :: panel
        !> How many, and these, ascending, shape (most_points)
        integer, intent(out) :: number
        real(wp), intent(out) :: points(:), weights(:)
        real(wp) :: from, length
        integer :: k, n, formula

        from = 0.0_wp
        length = 1.0_wp
        formula = panels%one
        if (panels%number > 1) then
            from = panels%border(panel - 1)
            length = panels%border(panel) - from
            formula = panels%formula(panel)
        end if
        number = points_in(formula)
        n = number/2
        do k = 1, n
            points(k) = from + length*place(before(formula) + k)
            points(number + 1 - k) = from + length*(1 - place(before(formula) + k))
            weights(k) = length*share(before(formula) + k)
            weights(number + 1 - k) = weights(k)
        end do
    end subroutine points_of

end module gapbeam_quadrature

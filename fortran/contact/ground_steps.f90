!> Steps into which pieces of a beam on the ground are cut so that the series of their fields are short.
module gapbeam_ground_steps
    use gapbeam_kinds, only: wp
    use gapbeam_piece, only: piece_type, is_tapered
    use gapbeam_taper, only: steps_of_taper, share_of_taper
    use gapbeam_foundation_stretch, only: stretch_between
    use gapbeam_foundation, only: stretch_type, decay_lengths
    use gapbeam_laws, only: law_hardening
    use gapbeam_layers, only: layer_type, law_piece_type, has_points, falls
    use gapbeam_ground_laws, only: between
    implicit none
    private
    public :: steps_on, border_of_step, decays_between, greatest_modulus

contains

    !> Into how many steps a piece is cut in any case: where the modulus varies or the beam tapers, and under compression, series
    !> hold for beta*length <= 1. Laws that stiffen may need more (gapbeam_zones)
    pure function steps_on(layers, laws, piece, stiffer) result(steps)
        !> Layers of ground under the piece, and the pieces of all laws
        type(layer_type), intent(in) :: layers(:)
        type(law_piece_type), intent(in) :: laws(:)
        type(piece_type), intent(in) :: piece
        !> Modulus of those that do beside that at first; default 0
        real(wp), intent(in), optional :: stiffer
        integer :: steps, k
        real(wp) :: modulus
        logical :: tapers, varies
        type(piece_type) :: pressed

        modulus = 0.0_wp
        if (present(stiffer)) modulus = stiffer
        tapers = is_tapered(piece)
        varies = tapers .or. modulus > 0.0_wp .or. max(piece%compression, piece%pull) > 0.0_wp &
            .or. abs(piece%tension_change) > 0.0_wp
        do k = 1, size(layers)
            associate (layer => layers(k))
                if (.not. has_points(layer)) then
                    ! Also where a law is curved
                    varies = varies .or. greatest_modulus(layer, laws) > 0.0_wp
                else if (layer%law_last >= layer%law_first) then
                    associate (own => laws(layer%law_first:layer%law_last))
                        if (.not. (tapers .or. falls(layer, laws) .or. any(abs(own%slope_a - own%slope_b) > 0.0_wp))) cycle
                    end associate
                    varies = .true.
                else
                    varies = varies .or. abs(layer%modulus_a - layer%modulus_b) > 0.0_wp
                end if
                modulus = modulus + greatest_modulus(layer, laws)
            end associate
        end do
        steps = 1
        if (.not. varies) return
        pressed = piece
        if (piece%compression > 0.0_wp) then
            pressed%tension = sign(max(piece%compression, piece%pull, piece%tension + max(0.0_wp, piece%tension_change)), -1.0_wp)
            pressed%tension_change = 0.0_wp
        else if (piece%pull > 0.0_wp) then
            pressed%tension = piece%pull
            pressed%tension_change = 0.0_wp
        end if
        steps = max(1, ceiling(decays_between(pressed, 0.0_wp, piece%length, modulus)))
        if (.not. tapers) return
        steps = steps_of_taper(piece)
        steps = steps*max(1, ceiling(maxval([(decays_between(pressed, border(k - 1), border(k), modulus), k=1, steps)])))

    contains

        !> Where a step of the taper ends
        pure function border(k) result(place)
            integer, intent(in) :: k
            real(wp) :: place

            place = border_of_step(piece, k, steps)
        end function border

    end function steps_on

    !> Decay lengths between two places of a piece on ground of a modulus, as if it were as soft as at the softer one
    pure function decays_between(piece, from, to, modulus) result(number)
        type(piece_type), intent(in) :: piece
        real(wp), intent(in) :: from, to, modulus
        real(wp) :: number
        type(stretch_type) :: stretch

        stretch = stretch_between(piece, from, to)
        stretch%modulus_a = modulus
        stretch%modulus_b = modulus
        number = decay_lengths(stretch)
    end function decays_between

    !> Where a step of a piece ends: equal ones, but where the beam tapers much those of equal factors of its depth
    pure function border_of_step(piece, step, steps) result(place)
        type(piece_type), intent(in) :: piece
        !> From 0, where the first begins, and how many there are
        integer, intent(in) :: step, steps
        real(wp) :: place

        place = between(0.0_wp, piece%length, step, steps)
        if (.not. is_tapered(piece) .or. step == 0 .or. step == steps) return
        if (steps_of_taper(piece) > 1) place = piece%length*share_of_taper(piece, real(step, wp)/steps)
    end function border_of_step

    !> Greatest modulus of a layer, wherever the beam is, also where its force falls; of a law that stiffens without end the one at
    !> first
    pure function greatest_modulus(layer, laws) result(modulus)
        type(layer_type), intent(in) :: layer
        !> Pieces of all laws
        type(law_piece_type), intent(in) :: laws(:)
        real(wp) :: modulus

        if (.not. has_points(layer)) then
            modulus = max(layer%parameter_a(1), layer%parameter_b(1))
            if (layer%law == law_hardening) modulus = max(modulus, layer%parameter_a(3), layer%parameter_b(3))
        else if (layer%law_last >= layer%law_first) then
            associate (own => laws(layer%law_first:layer%law_last))
                modulus = max(maxval(abs(own%slope_a)), maxval(abs(own%slope_b)))
            end associate
        else
            modulus = max(layer%modulus_a, layer%modulus_b)
        end if
    end function greatest_modulus

end module gapbeam_ground_steps

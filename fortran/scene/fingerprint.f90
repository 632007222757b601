!> A number by which a model is known.
module gapbeam_fingerprint
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_scene, only: model_type, gapbeam_unchanged
    implicit none
    private
    public :: fingerprint

contains

    !> A number that another model, or one with other loads, hardly ever has: results are known by it
    pure function fingerprint(model) result(number)
        !> With all its arrays allocated
        type(model_type), intent(in) :: model
        integer :: number
        integer(int64) :: all_bits
        integer :: i

        all_bits = 0
        do i = 1, size(model%spans)
            associate (s => model%spans(i))
                call mix(all_bits, [s%length, s%EI, s%GA, s%EA, s%N, s%mass])
            end associate
        end do
        if (model%N_grows) call mix(all_bits, [1.0_wp])
        if (model%axial_loads_bend) call mix(all_bits, [2.0_wp])
        if (model%stretching) call mix(all_bits, [3.0_wp])
        if (model%with_trains) call mix(all_bits, [4.0_wp])
        do i = 1, size(model%masses, 2)
            call mix(all_bits, model%masses(:, i))
        end do
        call mix(all_bits, model%hinges)
        if (any(model%hinge_stiffness > 0.0_wp)) call mix(all_bits, model%hinge_stiffness)
        if (allocated(model%sections)) then
            do i = 1, size(model%sections)
                associate (s => model%sections(i))
                    call mix(all_bits, [s%from, s%to, s%EI, s%GA, s%EA, s%N])
                    if (s%friction > 0.0_wp) call mix(all_bits, [s%friction])
                    if (s%friction_to > gapbeam_unchanged .or. s%bedding <= huge(1.0_wp)) then
                        call mix(all_bits, [s%friction_to, s%bedding])
                    end if
                    if (max(s%EI_to, s%GA_to, s%EA_to) > gapbeam_unchanged) then
                        call mix(all_bits, [s%EI_to, s%GA_to, s%EA_to, real([s%EI_power, s%GA_power, s%EA_power], wp)])
                    end if
                end associate
            end do
        end if
        do i = 1, size(model%supports)
            associate (s => model%supports(i))
                call mix(all_bits, [s%x, s%stiffness, s%gap, s%settlement, s%rotation, real([s%node, s%side, s%direction], wp)])
                call mix(all_bits, [real(s%law, wp), s%parameter])
                if (s%friction > 0.0_wp) call mix(all_bits, [s%friction])
            end associate
        end do
        if (allocated(model%law)) then
            do i = 1, size(model%law)
                associate (point => model%law(i), s => model%supports(model%law(i)%support))
                    call mix(all_bits, [real([point%support, s%unloading], wp), point%displacement, point%force])
                end associate
            end do
        end if
        call mix_foundations(all_bits, model)
        do i = 1, size(model%loads)
            associate (load => model%loads(i))
                call mix(all_bits, [load%x, load%to, load%value, load%value_to, real([load%kind, load%case, load%node], wp)])
            end associate
        end do
        number = int(ibits(ieor(all_bits, ishft(all_bits, -32)), 0, 31))
    end function fingerprint

    !> Mix foundations into a fingerprint
    pure subroutine mix_foundations(all_bits, model)
        integer(int64), intent(inout) :: all_bits
        !> Its foundations may not be allocated; with them their profiles and laws are
        type(model_type), intent(in) :: model
        integer :: i

        if (.not. allocated(model%foundations)) return
        do i = 1, size(model%foundations)
            associate (f => model%foundations(i))
                call mix(all_bits, [f%from, f%to, f%k, f%k_to, f%gap, f%gap_to, f%shear, real(f%side, wp)])
                call mix(all_bits, [real(f%law, wp), f%parameter, f%parameter_to])
            end associate
        end do
        do i = 1, size(model%ground)
            associate (point => model%ground(i))
                call mix(all_bits, [real(point%foundation, wp), point%x, point%value, real(point%quantity, wp)])
            end associate
        end do
        do i = 1, size(model%ground_law)
            associate (point => model%ground_law(i))
                call mix(all_bits, [real(point%foundation, wp), point%displacement, point%force, point%x])
            end associate
        end do
    end subroutine mix_foundations

    !> Mix the bits of numbers into a fingerprint: a linear map of all bits so far, plus the new ones, modulo 2
    pure subroutine mix(number, values)
        integer(int64), intent(inout) :: number
        real(wp), intent(in) :: values(:)
        integer(int64) :: bits
        integer :: i

        do i = 1, size(values)
            bits = transfer(values(i), bits)
            number = ieor(ieor(ishftc(number, 7), ishft(number, -9)), bits)
        end do
    end subroutine mix

end module gapbeam_fingerprint

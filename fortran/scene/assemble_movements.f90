!> Assembly of loads that move supports and foundations.
module gapbeam_assemble_movements
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: gapbeam_movement, gapbeam_ground_movement, gapbeam_dead
    use gapbeam_input_error, only: of_loads
    use gapbeam_check, only: entry_type, refuse_number
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_tables, only: place_of, distance, between
    implicit none
    private
    public :: take_movements, move_layers

contains

    !> Movements of supports: those with the dead loads are settlements, the others grow with the load factor
    subroutine take_movements(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        associate (model => assembled%model)
            if (.not. any(model%loads%kind == gapbeam_movement .and. abs(model%loads%value) > 0.0_wp)) return
            allocate (assembled%given_settlement(size(model%supports)), assembled%growth(size(model%supports)), stat=stat)
            if (failed(stat, error)) return
            assembled%given_settlement(:) = model%supports%settlement
            assembled%growth(:) = 0.0_wp
            do i = 1, size(model%loads)
                associate (load => model%loads(i))
                    if (load%kind /= gapbeam_movement) cycle
                    associate (s => model%supports(load%node), growth => assembled%growth(load%node))
                        if (load%case == gapbeam_dead) then
                            s%settlement = s%settlement + load%value
                        else
                            growth = growth + load%value
                        end if
                        if (abs(s%settlement) + abs(growth) <= huge(growth)) cycle
                        call refuse_number(error, entry_type(of_loads, i, size(model%loads)), "value", load%value, &
                                           "a smaller movement")
                        return
                    end associate
                end associate
            end do
            if (.not. any(abs(assembled%growth) > 0.0_wp)) deallocate (assembled%growth)
        end associate
    end subroutine take_movements

    !> Move layers, in the user's units: with the dead loads from the start, with the others while the load factor grows
    subroutine move_layers(assembled, error)
        !> Layers that no load has moved, in
        type(assembled_type), intent(inout) :: assembled
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        if (allocated(assembled%layer_growth)) deallocate (assembled%layer_growth)
        associate (loads => assembled%model%loads)
            if (any(loads%kind == gapbeam_ground_movement .and. loads%case /= gapbeam_dead .and. &
                    (abs(loads%value) > 0.0_wp .or. abs(loads%value_to) > 0.0_wp))) then
                allocate (assembled%layer_growth(2, size(assembled%layers)), source=0.0_wp, stat=stat)
                if (failed(stat, error)) return
            end if
            do i = 1, size(loads)
                if (loads(i)%kind == gapbeam_ground_movement) call move_foundation(assembled, i)
            end do
        end associate
    end subroutine move_layers

    !> Move the layers of one foundation by one load
    pure subroutine move_foundation(assembled, number)
        type(assembled_type), intent(inout) :: assembled
        !> Of the load
        integer, intent(in) :: number
        real(wp) :: by(2)
        integer :: j, k

        associate (load => assembled%model%loads(number), from => assembled%foundation_from, to => assembled%foundation_to)
            do j = from(load%node) + 1, to(load%node)
                by(:) = [movement_at(j - 1), movement_at(j)]
                do k = assembled%layer_first(j), assembled%layer_first(j + 1) - 1
                    associate (layer => assembled%layers(k))
                        if (layer%foundation /= load%node) cycle
                        if (load%case == gapbeam_dead) then
                            layer%contact_a = layer%contact_a + by(1)
                            layer%contact_b = layer%contact_b + by(2)
                        else if (allocated(assembled%layer_growth)) then
                            assembled%layer_growth(:, k) = assembled%layer_growth(:, k) + by
                        end if
                    end associate
                end do
            end do
        end associate

    contains

        !> The movement at a point
        pure function movement_at(point) result(movement)
            integer, intent(in) :: point
            real(wp) :: movement

            associate (load => assembled%model%loads(number))
                associate (left => place_of(assembled, assembled%foundation_from(load%node)), &
                           right => place_of(assembled, assembled%foundation_to(load%node)))
                    movement = between(load%value, load%value_to, distance(assembled, left, place_of(assembled, point)) &
                                       /distance(assembled, left, right))
                end associate
            end associate
        end function movement_at

    end subroutine move_foundation

end module gapbeam_assemble_movements

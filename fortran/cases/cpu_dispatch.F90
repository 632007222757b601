!> Dispatch of eight cases to the best instructions that the processor has.
!> Modules whose names end in _v3 and _v4 are the same sources compiled for AVX2 and for AVX-512 (x86-64-v3 and v4 of the psABI),
!> those with _own for stiffnesses that differ from case to case (gapbeam_lane_stiffness); all give the same digits
module gapbeam_cpu_dispatch
    use, intrinsic :: iso_c_binding, only: c_int
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_lane_procedures, only: compiled_here
    use gapbeam_lane_procedures_own, only: compiled_here_own => compiled_here
#ifdef GAPBEAM_LEVELS
    use gapbeam_lane_procedures_v3, only: compiled_here_v3 => compiled_here
    use gapbeam_lane_procedures_own_v3, only: compiled_here_own_v3 => compiled_here
    use gapbeam_lane_procedures_v4, only: compiled_here_v4 => compiled_here
    use gapbeam_lane_procedures_own_v4, only: compiled_here_own_v4 => compiled_here
#endif
    implicit none
    private
    public :: best_level, least_level, compiled_at

    !> Level of what every processor has
    integer, parameter :: least_level = 2

#ifdef GAPBEAM_LEVELS
    interface
        !> cases/processor.c
        pure function level_of_processor() result(level) bind(c, name="lanes_level_of_processor")
            import :: c_int
            implicit none
            integer(c_int) :: level
        end function level_of_processor
    end interface
#endif

contains

    !> The highest level at which this processor can compute
    pure function best_level() result(level)
        integer :: level

        level = least_level
#ifdef GAPBEAM_LEVELS
        level = level_of_processor()
#endif
    end function best_level

    !> The procedures of a level
    function compiled_at(level, with_own_spans) result(compiled)
        !> From least_level to best_level(); 0: that
        integer, intent(in) :: level
        !> Has every case stiffnesses of its own
        logical, intent(in) :: with_own_spans
        type(compiled_type) :: compiled

        select case (merge(level, best_level(), level > 0))
#ifdef GAPBEAM_LEVELS
        case (4)
            compiled = compiled_here_v4()
            if (with_own_spans) compiled = compiled_here_own_v4()
        case (3)
            compiled = compiled_here_v3()
            if (with_own_spans) compiled = compiled_here_own_v3()
#endif
        case default
            compiled = compiled_here()
            if (with_own_spans) compiled = compiled_here_own()
        end select
    end function compiled_at

end module gapbeam_cpu_dispatch

!> Beams in quadruple precision, from the numbers of their pieces where these are known
module gapbeam_refined
    use gapbeam_kinds, only: wp, qp
    use gapbeam_link, only: piece_type, piece_load_type
    use gapbeam_model, only: beam_type, node_support_type
    use gapbeam_link_quad, only: fine_piece_type => piece_type, fine_load_type => piece_load_type, fine_link_type => link_type, &
        condense_link
    use gapbeam_model_quad, only: fine_beam_type => beam_type, fine_support_type => node_support_type, new_beam
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type, new_fine_workspace => new_workspace, &
        set_fine_loads => set_loads
    use gapbeam_polyline_quad, only: join_pieces
    implicit none
    private
    public :: detail_type, refine_beam, refine_loaded_beam, condense_again, fine_piece, fine_load

    !> What links are made of: the scene's own numbers
    type :: detail_type
        !> Pieces, and their dead and live loads, shape (npiece); not associated where there are the links only
        type(piece_type), pointer :: pieces(:) => null()
        type(piece_load_type), pointer :: dead(:) => null(), live(:) => null()
        !> Last piece of every link, shape (n)
        integer, pointer :: last(:) => null()
    end type detail_type

contains

    !> The beam in quadruple precision
    subroutine refine_beam(beam, detail, fine)
        !> The beam, and what its links are made of
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        !> The same, its links condensed anew where their pieces are known
        type(fine_beam_type), intent(out) :: fine
        type(fine_link_type), allocatable :: links(:)

        allocate (links(size(beam%links)))
        if (associated(detail%pieces)) then
            call condense_again(detail, links)
        else
            associate (l => beam%links)
                links%length = l%length
                links%inverse = 1/links%length
                links%bending = l%bending
                links%sum_a = l%sum_a
                links%sum_b = l%sum_b
                links%faa = l%faa
                links%fab = l%fab
                links%fbb = l%fbb
                links%determinant = l%determinant
            end associate
            call copy_load_terms(beam, links)
        end if
        call new_beam(links, beam%kind, fine_reciprocal(beam%compliance), real(beam%force, qp), real(beam%couple, qp), &
                      fine_support(beam%supports), fine, beam%turning, beam%turned)
        call join_pieces(fine%supports)
        fine%watch = beam%watch
    end subroutine refine_beam

    !> The beam in quadruple precision, and room for its solution at a load factor
    subroutine refine_loaded_beam(beam, detail, factor, fine, fine_work)
        !> As for refine_beam
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        !> Factor of the live loads
        real(qp), intent(in) :: factor
        type(fine_beam_type), intent(out) :: fine
        !> With the loads set
        type(fine_workspace_type), intent(out) :: fine_work

        call refine_beam(beam, detail, fine)
        call new_fine_workspace(fine, fine_work)
        call set_fine_loads(fine, factor, fine_work)
    end subroutine refine_loaded_beam

    !> What the loads do to the links, as it is in double precision
    pure subroutine copy_load_terms(beam, links)
        type(beam_type), intent(in) :: beam
        type(fine_link_type), intent(inout) :: links(:)
        integer :: i

        do i = 1, size(links)
            associate (from => beam%links(i), to => links(i))
                to%turn_a = from%turn_a
                to%turn_b = from%turn_b
                to%shear_a = from%shear_a
                to%shear_b = from%shear_b
                to%load_sum = from%load_sum
                to%turn_sum = from%turn_sum
            end associate
        end do
    end subroutine copy_load_terms

    !> Condense the pieces between nodes
    subroutine condense_again(detail, links)
        type(detail_type), intent(in) :: detail
        type(fine_link_type), intent(out) :: links(:)
        type(fine_piece_type), allocatable :: pieces(:)
        type(fine_load_type), allocatable :: dead(:), live(:)
        real(qp), allocatable :: work(:)
        integer :: i, first, longest

        longest = detail%last(1)
        do i = 2, size(links)
            longest = max(longest, detail%last(i) - detail%last(i - 1))
        end do
        allocate (pieces(longest), dead(longest), live(longest), work(longest))
        first = 1
        do i = 1, size(links)
            associate (n => detail%last(i) - first + 1, last => detail%last(i))
                pieces(1:n) = fine_piece(detail%pieces(first:last))
                dead(1:n) = fine_load(detail%dead(first:last))
                live(1:n) = fine_load(detail%live(first:last))
                call condense_link(pieces(1:n), dead(1:n), live(1:n), work, links(i))
            end associate
            first = detail%last(i) + 1
        end do
    end subroutine condense_again

    !> A piece in quadruple precision
    elemental function fine_piece(piece) result(fine)
        type(piece_type), intent(in) :: piece
        type(fine_piece_type) :: fine

        fine = fine_piece_type(real(piece%length, qp), fine_reciprocal(piece%flexibility), &
                               fine_reciprocal(piece%shear_flexibility), fine_reciprocal(piece%hinge), &
                               fine_reciprocal(piece%flexibility_to), fine_reciprocal(piece%shear_flexibility_to), piece%power, &
                               piece%shear_power, real(piece%tension, qp), real(piece%slope_stiffness, qp), &
                               real(piece%tension_change, qp), real(piece%compression, qp), real(piece%mass, qp), &
                               real(piece%pull, qp))
    end function fine_piece

    !> A reciprocal in quadruple precision: of the stiffness that the user gave, which two roundings give back, mostly exactly
    elemental function fine_reciprocal(flexibility) result(fine)
        real(wp), intent(in) :: flexibility
        real(qp) :: fine

        fine = 0.0_qp
        if (flexibility > 0.0_wp) fine = 1/real(1/flexibility, qp)
    end function fine_reciprocal

    !> A support in quadruple precision
    elemental function fine_support(s) result(fine)
        type(node_support_type), intent(in) :: s
        type(fine_support_type) :: fine

        fine = fine_support_type(s%node, s%side, real(s%stiffness, qp), real(s%contact, qp), s%breakpoint, s%more, s%passed, &
                                 real(s%force, qp), real(s%before, qp))
    end function fine_support

    !> A load in quadruple precision
    elemental function fine_load(load) result(fine)
        type(piece_load_type), intent(in) :: load
        type(fine_load_type) :: fine

        fine = fine_load_type(real(load%qa, qp), real(load%qb, qp), real(load%kappa, qp), real(load%force, qp), &
                              real(load%couple, qp), real(load%kink_a, qp), real(load%kink_b, qp), real(load%couple_a, qp), &
                              real(load%couple_b, qp), real(load%rise, qp))
    end function fine_load

end module gapbeam_refined

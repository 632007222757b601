# The paper's beam in Julia, by ccall. Not tried: no Julia could be installed where this was written.
#
#     LD_LIBRARY_PATH=.../lib julia paper_beam.jl
using Printf

const lib = "libgapbeam"

# gapbeam_model of gapbeam.h; gapbeam_model_init refuses it if its size is not the library's
mutable struct Model
    size::Csize_t
    spans::Cint
    length::Ptr{Cdouble}
    EI::Ptr{Cdouble}
    GA::Ptr{Cdouble}
    EA::Ptr{Cdouble}
    hinges::Cint
    hinge_x::Ptr{Cdouble}
    supports::Cint
    support_x::Ptr{Cdouble}
    support_node::Ptr{Cint}
    support_side::Ptr{Cint}
    support_stiffness::Ptr{Cdouble}
    support_gap::Ptr{Cdouble}
    support_settlement::Ptr{Cdouble}
    support_rotation::Ptr{Cdouble}
    support_direction::Ptr{Cint}
    loads::Cint
    load_kind::Ptr{Cint}
    load_case::Ptr{Cint}
    load_x::Ptr{Cdouble}
    load_node::Ptr{Cint}
    load_to::Ptr{Cdouble}
    load_value::Ptr{Cdouble}
    load_value_to::Ptr{Cdouble}
    Model() = new()
end

check(status, message="") = status == 0 || error(
    unsafe_string(@ccall lib.gapbeam_status_message(status::Cint)::Cstring) * ": " * message)

spans, EI = fill(2.0, 3), fill(44.5, 3)
node, side, rotation = Cint[0, 1, 2, 3], Cint[0, -1, 1, 1], [Inf, 0.0, 0.0, 0.0]
kind, load_node, force = Cint[1, 1, 1], Cint[1, 2, 3], [0.70707, -4.3597, 2.1155]

model = Model()
check(@ccall lib.gapbeam_model_init(model::Ref{Model}, sizeof(Model)::Csize_t)::Cint)
message = zeros(UInt8, 200)
beam, state = Ref{Ptr{Cvoid}}(C_NULL), Ref{Ptr{Cvoid}}(C_NULL)
GC.@preserve spans EI node side rotation kind load_node force begin
    model.spans, model.length, model.EI = 3, pointer(spans), pointer(EI)
    model.supports, model.support_node, model.support_side = 4, pointer(node), pointer(side)
    model.support_rotation = pointer(rotation)
    model.loads, model.load_kind, model.load_node, model.load_value = 3, pointer(kind), pointer(load_node), pointer(force)
    check(@ccall(lib.gapbeam_prepare(model::Ref{Model}, beam::Ref{Ptr{Cvoid}}, message::Ptr{UInt8}, 200::Csize_t)::Cint),
          GC.@preserve message unsafe_string(pointer(message)))
end
check(@ccall lib.gapbeam_new_state(state::Ref{Ptr{Cvoid}})::Cint)
for step in 1:10
    check(@ccall lib.gapbeam_solve(beam[]::Ptr{Cvoid}, (step / 10)::Cdouble, C_NULL::Ptr{Cvoid}, state[]::Ptr{Cvoid},
                                   C_NULL::Ptr{UInt8}, 0::Csize_t)::Cint)
end
reaction, deflection, opening, couple, condition = zeros(4), zeros(4), zeros(4), zeros(4), zeros(Cint, 4)
check(@ccall lib.gapbeam_get_supports(beam[]::Ptr{Cvoid}, state[]::Ptr{Cvoid}, reaction::Ptr{Cdouble}, deflection::Ptr{Cdouble},
                                      opening::Ptr{Cdouble}, couple::Ptr{Cdouble}, condition::Ptr{Cint})::Cint)
for (name, values) in (("reaction", reaction), ("deflection", deflection), ("opening", opening), ("couple", couple))
    println(rpad(name, 12), join(map(v -> @sprintf("%25.16E", v), values)))
end
@ccall lib.gapbeam_free_state(state[]::Ptr{Cvoid})::Cvoid
@ccall lib.gapbeam_free_beam(beam[]::Ptr{Cvoid})::Cvoid

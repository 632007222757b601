Attribute VB_Name = "Gapbeam"
' The paper's beam in Excel's VBA (64 bit). Not tried: there is no Excel, and no Windows build of the library, where this was
' written. gapbeam.dll must be in a folder of the PATH, with the DLLs of gfortran and LAPACK.
Option Explicit

' gapbeam_model of gapbeam.h; the fillers keep pointers at multiples of 8 bytes. gapbeam_model_init refuses it if its size is not
' the library's
Private Type GapbeamModel
    size As LongPtr
    spans As Long
    filler1 As Long
    length As LongPtr
    EI As LongPtr
    GA As LongPtr
    EA As LongPtr
    hinges As Long
    filler2 As Long
    hinge_x As LongPtr
    supports As Long
    filler3 As Long
    support_x As LongPtr
    support_node As LongPtr
    support_side As LongPtr
    support_stiffness As LongPtr
    support_gap As LongPtr
    support_settlement As LongPtr
    support_rotation As LongPtr
    support_direction As LongPtr
    loads As Long
    filler4 As Long
    load_kind As LongPtr
    load_case As LongPtr
    load_x As LongPtr
    load_node As LongPtr
    load_to As LongPtr
    load_value As LongPtr
    load_value_to As LongPtr
End Type

Private Declare PtrSafe Function gapbeam_model_init Lib "gapbeam.dll" (model As GapbeamModel, ByVal size As LongPtr) As Long
Private Declare PtrSafe Function gapbeam_infinity Lib "gapbeam.dll" () As Double
Private Declare PtrSafe Function gapbeam_solve_model Lib "gapbeam.dll" (model As GapbeamModel, ByVal factor As Double, _
    ByVal options As LongPtr, reaction As Double, deflection As Double, opening As Double, couple As Double, _
    condition As Long, ByVal count As Long, ByVal x As LongPtr, ByVal fields As LongPtr, ByVal message As String, _
    ByVal message_size As LongPtr) As Long

' Reactions, deflections, openings and couples of the four supports go to the cells A1:D4
Public Sub PaperBeam()
    Dim model As GapbeamModel, message As String, status As Long, k As Long
    Dim length(2) As Double, EI(2) As Double, rotation(3) As Double, force(2) As Double
    Dim node(3) As Long, side(3) As Long, kind(2) As Long, loadNode(2) As Long
    Dim reaction(3) As Double, deflection(3) As Double, opening(3) As Double, couple(3) As Double, condition(3) As Long

    For k = 0 To 2
        length(k) = 2: EI(k) = 44.5: kind(k) = 1: loadNode(k) = k + 1
    Next k
    For k = 0 To 3
        node(k) = k
    Next k
    side(1) = -1: side(2) = 1: side(3) = 1
    rotation(0) = gapbeam_infinity()
    force(0) = 0.70707: force(1) = -4.3597: force(2) = 2.1155
    If gapbeam_model_init(model, LenB(model)) <> 0 Then
        MsgBox "gapbeam.dll is of another version": Exit Sub
    End If
    model.spans = 3: model.length = VarPtr(length(0)): model.EI = VarPtr(EI(0))
    model.supports = 4: model.support_node = VarPtr(node(0)): model.support_side = VarPtr(side(0))
    model.support_rotation = VarPtr(rotation(0))
    model.loads = 3: model.load_kind = VarPtr(kind(0)): model.load_node = VarPtr(loadNode(0))
    model.load_value = VarPtr(force(0))
    message = String$(200, vbNullChar)
    status = gapbeam_solve_model(model, 1#, 0, reaction(0), deflection(0), opening(0), couple(0), condition(0), 0, 0, 0, _
        message, 200)
    If status <> 0 Then
        MsgBox "status " & status & ": " & Left$(message, InStr(message, vbNullChar) - 1): Exit Sub
    End If
    For k = 0 To 3
        Cells(k + 1, 1) = reaction(k): Cells(k + 1, 2) = deflection(k)
        Cells(k + 1, 3) = opening(k): Cells(k + 1, 4) = couple(k)
    Next k
End Sub

C     The Fortran 77 interface: INFO for every argument, closed
C     forms. Reports in the Test Anything Protocol.
C     Compiled with -std=legacy.
      PROGRAM TSTF77
      INTEGER NFAIL, NCHECK
      COMMON /TALLY/ NFAIL, NCHECK
      NFAIL = 0
      NCHECK = 0
      CALL REFUSE
      CALL CLOSED
      CALL TIPPED
      CALL LAWS
      CALL GROUND
      CALL CURVED
      CALL TRAINS
      CALL COLUMN
      CALL HANDLE
      WRITE (*, '(A, I3)') '1..', NCHECK
      IF (NFAIL .GT. 0) STOP 1
      END
C
C     One condition
      SUBROUTINE CHECK(GOOD, NAME)
      LOGICAL GOOD
      CHARACTER*(*) NAME
      INTEGER NFAIL, NCHECK
      COMMON /TALLY/ NFAIL, NCHECK
      NCHECK = NCHECK + 1
      IF (GOOD) THEN
         WRITE (*, '(A, I3, 2A)') 'ok ', NCHECK, ' - ', NAME
      ELSE
         NFAIL = NFAIL + 1
         WRITE (*, '(A, I3, 2A)') 'not ok ', NCHECK, ' - ', NAME
      END IF
      END
C
C     INFO, and the number of the entry
      SUBROUTINE EXPECT(INFO, WANTED, NAME)
      INTEGER INFO, WANTED
      CHARACTER*(*) NAME
      CALL CHECK(INFO .EQ. WANTED, NAME)
      IF (INFO .NE. WANTED) WRITE (*, '(A, 2I6)') '#', INFO, WANTED
      END
C
C     A number, to 13 digits
      SUBROUTINE CLOSE(X, Y, NAME)
      DOUBLE PRECISION X, Y
      CHARACTER*(*) NAME
      CALL CHECK(ABS(X - Y) .LE. 1.0D-13*ABS(Y), NAME)
      END
C
C     Two spans of 2, EI = 100, a gap in the middle, uniform load 3
      SUBROUTINE TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), GBINF
      INTEGER ISUP(3,3), ILOAD(3,1), I, K
      EXTERNAL GBINF
      DO 10 K = 1, 2
         SPAN(1,K) = 2.0D0
         SPAN(2,K) = 100.0D0
         SPAN(3,K) = GBINF()
         SPAN(4,K) = GBINF()
   10 CONTINUE
      DO 30 K = 1, 3
         DO 20 I = 1, 5
            SUP(I,K) = 0.0D0
   20    CONTINUE
         SUP(2,K) = GBINF()
         ISUP(1,K) = 0
         ISUP(2,K) = 0
         ISUP(3,K) = K - 1
   30 CONTINUE
      ISUP(1,2) = 1
      SUP(3,2) = 0.001D0
      ILOAD(1,1) = 3
      ILOAD(2,1) = 0
      ILOAD(3,1) = -1
      ALOAD(1,1) = 0.0D0
      ALOAD(2,1) = 4.0D0
      ALOAD(3,1) = 3.0D0
      ALOAD(4,1) = 3.0D0
      END
C
C     What is refused, and how
      SUBROUTINE REFUSE
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION X(1), F(6), V(4,3), A(2,6), B(2,6), E(1)
      INTEGER ISUP(3,3), ILOAD(3,1), INFO, IENT, K(3), NEV, IE(2,1), NN
      INTEGER*8 BEAM, STATE
      EXTERNAL GHEVNT, GHFLDS, GHFREE, GHLOAD, GHMOTN, GHPREP, GHSOLV,
     +         GHSTAT
      EXTERNAL GHSUPP, GHXTRM
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      CALL GHPREP(0, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -1, 'NSPAN = 0')
      CALL GHPREP(2, SPAN, -1, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -3, 'NHINGE = -1')
      CALL GHPREP(2, SPAN, 0, HINGE, -1, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -5, 'NSUP = -1')
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, -1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -8, 'NLOAD = -1')
      SPAN(2,2) = -1.0D0
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -2, 'negative EI')
      CALL EXPECT(IENT, 2, 'of span 2')
      SPAN(2,2) = 100.0D0
      HINGE(1) = 4.0D0
      CALL GHPREP(2, SPAN, 1, HINGE, 3, ISUP, SUP, 0, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -4, 'hinge at the end')
      ISUP(1,3) = 9
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -6, 'no such side')
      CALL EXPECT(IENT, 3, 'of support 3')
      ISUP(1,3) = 0
      ALOAD(2,1) = 5.0D0
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -9, 'load off the beam')
      ALOAD(2,1) = 4.0D0
      CALL CHECK(BEAM .EQ. 0, 'no handle')
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, -1, 'nothing prepared')
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      STATE = 0
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, -5, 'no state')
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, BEAM, INFO)
      CALL EXPECT(INFO, -5, 'a beam is no state')
      CALL GHSTAT(STATE, INFO)
      CALL EXPECT(INFO, 0, 'a state')
      CALL GHSOLV(BEAM, 1.0D0, 2, 0, STATE, INFO)
      CALL EXPECT(INFO, -3, 'no such rule')
      CALL GHSOLV(BEAM, 1.0D0, 0, 2, STATE, INFO)
      CALL EXPECT(INFO, -4, 'no such start')
      CALL GHSOLV(BEAM, 1.0D0, 0, 1, STATE, INFO)
      CALL EXPECT(INFO, -5, 'nothing to start from')
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
      CALL EXPECT(INFO, -2, 'nothing solved')
      CALL GHXTRM(BEAM, STATE, A, B, INFO)
      CALL EXPECT(INFO, -2, 'nothing solved, extremes')
      CALL GHEVNT(BEAM, 0.0D0, 0, 1, STATE, NEV, E, IE, INFO)
      CALL EXPECT(INFO, -2, 'follow to 0')
      CALL GHEVNT(BEAM, 1.0D0, 0, -1, STATE, NEV, E, IE, INFO)
      CALL EXPECT(INFO, -4, 'negative room')
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'solved')
      X(1) = -0.1D0
      CALL GHFLDS(BEAM, STATE, 1, X, 0, F, INFO)
      CALL EXPECT(INFO, -4, 'place off the beam')
      CALL GHFLDS(BEAM, STATE, -1, X, 0, F, INFO)
      CALL EXPECT(INFO, -3, 'negative number of places')
      CALL GHFLDS(BEAM, STATE, 1, X, 7, F, INFO)
      CALL EXPECT(INFO, -5, 'no side of a place')
      CALL GHMOTN(BEAM, STATE, 3, NN, F, F, INFO)
      CALL EXPECT(INFO, -2, 'it does not move')
      CALL GHMOTN(BEAM, STATE, 2, NN, F, F, INFO)
      CALL EXPECT(INFO, -3, 'no room for a motion')
      ILOAD(1,1) = 0
      CALL GHLOAD(BEAM, 1, ILOAD, ALOAD, INFO)
      CALL EXPECT(INFO, -3, 'no such load')
      CALL GHLOAD(BEAM, -1, ILOAD, ALOAD, INFO)
      CALL EXPECT(INFO, -2, 'negative number of loads')
      ILOAD(1,1) = 3
      CALL GHFREE(BEAM, INFO)
      CALL EXPECT(INFO, 0, 'freed')
      CALL CHECK(BEAM .EQ. 0, 'it is 0')
      CALL GHLOAD(BEAM, 1, ILOAD, ALOAD, INFO)
      CALL EXPECT(INFO, -1, 'no beam to load')
      CALL GHFREE(STATE, INFO)
      END
C
C     The gap closes at 5 q L**4/384 EI = 0.001
      SUBROUTINE CLOSED
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION V(4,3), X(2), F(6,2)
      DOUBLE PRECISION A(2,6), B(2,6), C(9), E(4), FREE, R, FLEX
      INTEGER*8 BEAM, STATE
      INTEGER ISUP(3,3), ILOAD(3,1)
      INTEGER INFO, IENT, K(3), NEV, IE(2,4), KNOWN, IU(3), NI(5)
      INTEGER MAJOR, MINOR, IPATCH
      EXTERNAL GBVERS, GHCERT, GHEVNT, GHFLDS, GHFREE, GHINFO, GHLOAD,
     +         GHPREP
      EXTERNAL GHSOLV, GHSTAT, GHSUPP, GHXTRM
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      FREE = 5*3.0D0*256/(384*100.0D0)
      FLEX = 64/(48*100.0D0)
      R = (FREE - 0.001D0)/FLEX
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 1, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'solved by the paper''s rule')
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
      CALL CLOSE(V(1,2), R, 'reaction past the gap')
      CALL CLOSE(V(2,2), 0.001D0, 'deflection there')
      CALL CHECK(K(1) .EQ. 2 .AND. K(2) .EQ. 1, 'conditions')
      X(1) = 1.0D0
      X(2) = 2.0D0
      CALL GHFLDS(BEAM, STATE, 2, X, 1, F, INFO)
      CALL CLOSE(F(4,2), V(1,1) - 6, 'shear left of the support')
      CALL CLOSE(F(3,1), V(1,1) - 1.5D0, 'moment')
      CALL GHXTRM(BEAM, STATE, A, B, INFO)
      CALL CLOSE(A(1,4), 6 - V(1,1), 'largest shear')
      CALL CLOSE(B(1,4), 2.0D0, 'right of the support')
      CALL GHCERT(BEAM, STATE, C, KNOWN, IU, INFO)
      CALL CHECK(KNOWN .EQ. 1 .AND. C(5) .LT. 1.0D-11, 'bounds')
      CALL CHECK(IU(1) + IU(2) + IU(3) .EQ. 0, 'all decided')
      CALL GHEVNT(BEAM, 1.0D0, 0, 4, STATE, NEV, E, IE, INFO)
      CALL CHECK(NEV .EQ. 1 .AND. IE(1,1) .EQ. 2 .AND. IE(2,1) .EQ. 1,
     +           'one event')
      CALL CLOSE(E(1), 0.001D0/FREE, 'its factor')
      CALL GHINFO(STATE, E(2), NI, INFO)
      CALL CLOSE(E(2), 1.0D0, 'state at the end')
      CALL CHECK(NI(1) .EQ. 0 .AND. NI(2) .GT. 0, 'its numbers')
      ALOAD(3,1) = 4.0D0
      CALL GHLOAD(BEAM, 1, ILOAD, ALOAD, INFO)
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
      CALL EXPECT(INFO, -2, 'state of the old loads')
      ILOAD(1,1) = 1
      ALOAD(1,1) = 1.0D0
      ALOAD(3,1) = 25.0D0
      CALL GHLOAD(BEAM, 1, ILOAD, ALOAD, INFO)
      CALL EXPECT(INFO, 0, 'another load')
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
      CALL CLOSE(V(1,2), (25*44/4800.0D0 - 0.001D0)/FLEX, 'with it')
      CALL GBVERS(MAJOR, MINOR, IPATCH)
      CALL CHECK(MAJOR + MINOR + IPATCH .GT. 0, 'version')
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      END
C
C     A load beyond the last support lifts the beam off the first
      SUBROUTINE TIPPED
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION X(4), D(4)
      INTEGER*8 BEAM, STATE
      INTEGER ISUP(3,3), ILOAD(3,1), INFO, IENT, NN
      EXTERNAL GHFREE, GHMOTN, GHPREP, GHSOLV, GHSTAT
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      ISUP(1,1) = 1
      ILOAD(1,1) = 1
      ALOAD(1,1) = 4.0D0
      CALL GHPREP(2, SPAN, 0, HINGE, 2, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, 0, 'a plank')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 1, 'tips')
      CALL GHMOTN(BEAM, STATE, 4, NN, X, D, INFO)
      CALL CHECK(NN .EQ. 3 .AND. D(1) .LT. 0.0D0 .AND.
     +           D(3) .GT. 0.0D0, 'its right end goes down')
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      END
C
C     A simple beam of stiffness 1 in the middle over a support with
C     a law, a load of 2.2 on it: one that breaks, one that yields and
C     keeps a set
      SUBROUTINE LAWS
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION V(4,3), ALAW(2,3), FACT(2), SF(2,9), EF(9)
      DOUBLE PRECISION XL(2), C(9), X(4), D(4)
      INTEGER*8 BEAM, STATE, HIST
      INTEGER ISUP(3,3), ILOAD(3,1), ILAW(3), IUNL(3), IS(6,9), IE(4,9)
      INTEGER IL(4,2), N(6), K(3), INFO, IENT, KNOWN, IU(3)
      EXTERNAL GHCERT, GHEVNT, GHFREE, GHHENG, GHHGET, GHHIST, GHHMOT,
     +         GHHSOL, GHPRLW
      EXTERNAL GHSOLV, GHSTAT, GHSUPP
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      SPAN(2,1) = 4/3.0D0
      SPAN(2,2) = 4/3.0D0
      SUP(3,2) = 0.0D0
      ILOAD(1,1) = 1
      ALOAD(1,1) = 2.0D0
      ALOAD(3,1) = 2.2D0
      DO 10 INFO = 1, 3
         ILAW(INFO) = 2
         IUNL(INFO) = 0
   10 CONTINUE
      ALAW(1,1) = 0.1D0
      ALAW(2,1) = 1.0D0
      ALAW(1,2) = 0.1D0
      ALAW(2,2) = 0.0D0
      ALAW(1,3) = 1.0D0
      ALAW(2,3) = 0.0D0
      FACT(1) = 1.0D0
      FACT(2) = 0.0D0
      CALL GHPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            -1, ILAW, ALAW, IUNL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -11, 'NLAW = -1')
      CALL GHPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 2,
     +            ILAW, ALAW, IUNL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -12, 'a law that ends falling')
      CALL EXPECT(IENT, 2, 'of support 2')
      SUP(2,2) = 3.0D0
      CALL GHPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 3,
     +            ILAW, ALAW, IUNL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -12, 'a law and a stiffness')
      SUP(2,2) = SUP(2,1)
      IUNL(1) = 1
      CALL GHPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 3,
     +            ILAW, ALAW, IUNL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -14, 'unloading without a law')
      CALL EXPECT(IENT, 1, 'of support 1')
      IUNL(1) = 0
      CALL GHPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 3,
     +            ILAW, ALAW, IUNL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, 0, 'a support that breaks')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 0.1D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, -1, 'depends on the way of the load')
      CALL GHEVNT(BEAM, 0.1D0, 0, 9, STATE, N(1), EF, IE, INFO)
      CALL EXPECT(INFO, -1, 'and again')
      CALL GHHIST(BEAM, 0, FACT, 0, HIST, N, INFO)
      CALL EXPECT(INFO, -2, 'NFACT = 0')
      CALL GHHIST(BEAM, 1, FACT, 3, HIST, N, INFO)
      CALL EXPECT(INFO, -4, 'LIMIT = 3')
      CALL GHHIST(STATE, 1, FACT, 0, HIST, N, INFO)
      CALL EXPECT(INFO, -1, 'no beam')
      CALL GHHIST(BEAM, 1, FACT, 0, HIST, N, INFO)
      CALL EXPECT(INFO, 0, 'followed')
      CALL GHHGET(HIST, -1, SF, IS, 9, EF, IE, 2, XL, IL, INFO)
      CALL EXPECT(INFO, -2, 'MAXST = -1')
      CALL GHHGET(HIST, 9, SF, IS, -1, EF, IE, 2, XL, IL, INFO)
      CALL EXPECT(INFO, -5, 'no room for events')
      CALL GHHGET(HIST, 9, SF, IS, 9, EF, IE, -1, XL, IL, INFO)
      CALL EXPECT(INFO, -8, 'no room for limits')
      CALL GHHGET(BEAM, 9, SF, IS, 9, EF, IE, 2, XL, IL, INFO)
      CALL EXPECT(INFO, -1, 'no history')
      CALL GHHGET(HIST, 9, SF, IS, 9, EF, IE, 2, XL, IL, INFO)
      CALL EXPECT(INFO, 0, 'what it is made of')
      CALL GHHMOT(HIST, 4, X, D, INFO)
      CALL EXPECT(INFO, -1, 'it ends in no motion')
      CALL CHECK(N(2) .EQ. 1 .AND. N(3) .EQ. 1 .AND. N(4) .EQ. 4,
     +           'one event, one limit')
      CALL CLOSE(XL(1), 0.5D0, 'its factor')
      CALL CHECK(IL(1,1) .EQ. 1 .AND. IL(2,1) .EQ. 1 .AND.
     +           IL(3,1) .EQ. 1, 'what it is')
      CALL CHECK(IE(1,1) .EQ. 2 .AND. IE(2,1) .EQ. 12 .AND.
     +           IE(3,1) .EQ. 7 .AND. IE(4,1) .EQ. 2, 'it breaks')
      CALL CHECK(IS(3,1) .EQ. 1 .AND. IS(3,2) .EQ. 0 .AND.
     +           IS(6,2) .EQ. 1, 'stable before')
      CALL GHHSOL(BEAM, HIST, 9, 0.5D0, STATE, INFO)
      CALL EXPECT(INFO, -3, 'no such stretch')
      CALL GHHSOL(BEAM, HIST, 0, 0.7D0, STATE, INFO)
      CALL EXPECT(INFO, -4, 'not on the path')
      CALL GHHSOL(BEAM, HIST, IL(4,1), 0.5D0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'the landing')
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
      CALL CLOSE(V(2,2), 1.1D0, 'without the support')
      CALL CHECK(K(2) .EQ. 13, 'which is broken')
      CALL GHHENG(BEAM, HIST, 2, D(1), INFO)
      CALL EXPECT(INFO, -3, 'there is one limit')
      CALL GHHENG(BEAM, HIST, 1, D(1), INFO)
      CALL EXPECT(INFO, 0, 'the energy')
      CALL CLOSE(D(1), 0.5D0, 'that the beam sets free')
      CALL GHFREE(BEAM, INFO)
      ALAW(1,2) = 1.0D0
      ALAW(2,2) = 1.0D0
      IUNL(2) = 1
      CALL GHPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 2,
     +            ILAW, ALAW, IUNL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, 0, 'a support that keeps a set')
      CALL GHHSOL(BEAM, HIST, 0, 0.5D0, STATE, INFO)
      CALL EXPECT(INFO, -2, 'history of another beam')
      CALL GHFREE(HIST, INFO)
      CALL GHHIST(BEAM, 2, FACT, 0, HIST, N, INFO)
      CALL GHHGET(HIST, 0, SF, IS, 9, EF, IE, 0, XL, IL, INFO)
      CALL CHECK(N(2) .EQ. 3 .AND. N(3) .EQ. 0 .AND. N(4) .EQ. 0,
     +           'there and back')
      CALL CHECK(IE(3,1) .EQ. 4 .AND. IE(3,2) .EQ. 8 .AND.
     +           IE(3,3) .EQ. 0, 'yields, unloads, opens')
      CALL GHHSOL(BEAM, HIST, IE(4,3), 0.25D0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'on the way back')
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
      CALL CLOSE(V(3,2), 0.55D0, 'a gap is left')
      CALL CHECK(K(2) .EQ. 0, 'open')
      CALL GHCERT(BEAM, STATE, C, KNOWN, IU, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. C(3) .LT. 1.0D-14, 'certified')
      CALL GHFREE(HIST, INFO)
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      END
C
C     A rigid beam of 12 on ground that pushes up only, a force of 30 at
C     a distance of 2 from its left end: contact over three times that
      SUBROUTINE GROUND
      DOUBLE PRECISION SPAN(4,1), SUP(5,1), ALOAD(4,2), HINGE(1)
      DOUBLE PRECISION ALAW(2,1), FOUND(6,2), APROF(2,1), AFLAW(2,2)
      DOUBLE PRECISION Z(3,2), X(3), P(3), FV(6,1), FACT(1), EF(1), V(2)
      DOUBLE PRECISION C(9), GLAW(6,2), ATAB(2,2), GBINF
      INTEGER*8 BEAM, STATE, HIST
      INTEGER ISUP(3,1), ILOAD(3,2), ILAW(1), IUNL(1), IFOUND(2)
      INTEGER IPROF(1), IFLAW(2), IGLAW(2), ITAB(2,2), IU(1), IZ(2,2)
      INTEGER IE(4,1), N(6), INFO, IENT, NZ, KNOWN, I
      EXTERNAL GBINF, GHCERT, GHCONT, GHEVNT, GHFLDS, GHFREE, GHFRSP,
     +         GHGEVT
      EXTERNAL GHHIST, GHHSOL, GHLOAD, GHPRES, GHPRFD, GHPXTR, GHSOLV,
     +         GHSTAT
      SPAN(1,1) = 12.0D0
      SPAN(2,1) = GBINF()
      SPAN(3,1) = GBINF()
      SPAN(4,1) = GBINF()
      ILOAD(1,1) = 1
      ILOAD(2,1) = 0
      ILOAD(3,1) = -1
      ALOAD(1,1) = 2.0D0
      ALOAD(2,1) = 0.0D0
      ALOAD(3,1) = 30.0D0
      ALOAD(4,1) = 0.0D0
      DO 10 I = 1, 2
         IFOUND(I) = 1
         IGLAW(I) = 0
         FOUND(1,I) = 0.0D0
         FOUND(2,I) = 12.0D0
         FOUND(3,I) = 5.0D0
         FOUND(4,I) = 5.0D0
         FOUND(5,I) = 0.0D0
         FOUND(6,I) = 0.0D0
   10 CONTINUE
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, -1, IFOUND, FOUND, 0, IPROF,
     +            APROF, 0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -15, 'NFOUND = -1')
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, -1, IPROF,
     +            APROF, 0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, -18, 'NPROF = -1')
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            -1, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -21, 'NFLAW = -1')
      FOUND(3,2) = -5.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 2, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -16, 'a modulus below 0')
      CALL EXPECT(IENT, 2, 'of foundation 2')
      IPROF(1) = 2
      APROF(1,1) = GBINF()
      APROF(2,1) = 0.25D0
      FOUND(3,2) = 5.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 2, IFOUND, FOUND, 1, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -19, 'a profile at infinity')
      IFLAW(1) = 1
      IFLAW(2) = 1
      AFLAW(1,1) = 0.5D0
      AFLAW(2,1) = 1.0D0
      AFLAW(1,2) = 1.5D0
      AFLAW(2,2) = 0.5D0
      FOUND(3,1) = 0.0D0
      FOUND(4,1) = 0.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            2, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -22, 'a law that falls')
      CALL EXPECT(IENT, 1, 'of foundation 1')
      FOUND(3,1) = 5.0D0
      FOUND(4,1) = 5.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'solved')
      CALL GHCONT(BEAM, STATE, -1, NZ, Z, IZ, INFO)
      CALL EXPECT(INFO, -3, 'MAXZN = -1')
      Z(1,2) = 7.0D0
      CALL GHCONT(BEAM, STATE, 2, NZ, Z, IZ, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. NZ .EQ. 1 .AND.
     +           IZ(1,1) .EQ. 1 .AND. IZ(2,1) .EQ. 1 .AND.
     +           Z(1,2) .GT. 6.9D0, 'one zone')
      CALL CLOSE(Z(2,1), 6.0D0, 'its end')
      CALL CLOSE(Z(3,1), 30.0D0, 'its force')
      CALL GHFRSP(BEAM, STATE, -1, NZ, Z, IZ, INFO)
      CALL EXPECT(INFO, -3, 'MAXFR = -1')
      CALL GHFRSP(BEAM, STATE, 1, NZ, Z, IZ, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. NZ .EQ. 1 .AND. IZ(1,1) .EQ. 1,
     +           'one free span')
      CALL CLOSE(Z(1,1), 6.0D0, 'where it begins')
      CALL CLOSE(Z(3,1), 2.0D0, 'how far it is')
      X(1) = 0.0D0
      X(2) = 3.0D0
      X(3) = 13.0D0
      CALL GHPRES(BEAM, STATE, 2, X, 0, P, INFO)
      CALL EXPECT(INFO, 0, 'pressure')
      CALL CLOSE(P(1), 10.0D0, 'at the edge')
      CALL CLOSE(P(2), 5.0D0, 'in the middle')
      CALL GHPRES(BEAM, STATE, 3, X, 0, P, INFO)
      CALL EXPECT(INFO, -4, 'off the beam')
      CALL GHPRES(BEAM, STATE, -1, X, 0, P, INFO)
      CALL EXPECT(INFO, -3, 'NX = -1')
      CALL GHPXTR(BEAM, STATE, V, X, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. .NOT. ABS(V(2)) .GT. 0.0D0,
     +           'extremes')
      CALL CLOSE(V(1), 10.0D0, 'the largest pressure')
      X(1) = 0.0D0
      CALL GHFLDS(BEAM, STATE, 1, X, 0, FV, INFO)
      CALL CLOSE(FV(1,1), 2.0D0, 'deflection')
      CALL GHCERT(BEAM, STATE, C, KNOWN, IU, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. KNOWN .EQ. 1 .AND.
     +           C(6) .GT. 0.0D0 .AND. C(6) .LT. 1.0D-12, 'certified')
      FACT(1) = 1.0D0
      CALL GHEVNT(BEAM, 1.0D0, 0, 1, STATE, N(1), EF, IE, INFO)
      CALL EXPECT(INFO, -1, 'on the ground by GHGEVT')
      CALL GHGEVT(BEAM, 1.0D0, 0, -1, STATE, N(1), EF, IE, INFO)
      CALL EXPECT(INFO, -4, 'MAXEV = -1')
      CALL GHGEVT(BEAM, 1.0D0, 0, 0, STATE, N(1), EF, IE, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N(1) .EQ. 0, 'no change')
      CALL GHHIST(BEAM, 1, FACT, 0, HIST, N, INFO)
      CALL EXPECT(INFO, -1, 'no history')
      CALL GHHSOL(BEAM, HIST, 0, 0.5D0, STATE, INFO)
      CALL EXPECT(INFO, -2, 'nor its states')
      ILOAD(1,2) = 1
      ILOAD(2,2) = 1
      ILOAD(3,2) = -1
      ALOAD(1,2) = 1.0D0
      ALOAD(2,2) = 0.0D0
      ALOAD(3,2) = 30.0D0
      ALOAD(4,2) = 0.0D0
      ALOAD(1,1) = 3.0D0
      CALL GHLOAD(BEAM, 2, ILOAD, ALOAD, INFO)
      CALL EXPECT(INFO, 0, 'other loads')
      CALL GHCONT(BEAM, STATE, 2, NZ, Z, IZ, INFO)
      CALL EXPECT(INFO, -2, 'of which nothing is solved')
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'solved again')
      CALL GHCONT(BEAM, STATE, 2, NZ, Z, IZ, INFO)
      CALL CLOSE(Z(2,1), 6.0D0, 'the same resultant')
      CALL CLOSE(Z(3,1), 60.0D0, 'twice as great')
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
C     Its modulus by a table
      DO 20 I = 1, 2
         ITAB(1,I) = 1
         ITAB(2,I) = 1
         ATAB(1,I) = 12.0D0*(I - 1)
         ATAB(2,I) = 5.0D0
         FOUND(I + 2,1) = 0.0D0
   20 CONTINUE
      ALOAD(1,1) = 2.0D0
      ITAB(2,2) = 9
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 2, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL CHECK(INFO .LT. 0 .AND. BEAM .EQ. 0, 'no such table')
      ITAB(2,2) = 1
      ATAB(2,2) = -5.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 2, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -27, 'a table below 0')
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, -1, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -26, 'NTAB = -1')
      ATAB(2,2) = 5.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 2, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, 0, 'a table')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL GHCONT(BEAM, STATE, 2, NZ, Z, IZ, INFO)
      CALL CLOSE(Z(2,1), 6.0D0, 'the zone of the modulus')
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      END
C
C     A rigid beam of 12 on ground whose law and load both grow
C     threefold along it: 8 tanh(20 w/8) = 6 at its left end
      SUBROUTINE CURVED
      DOUBLE PRECISION SPAN(4,1), SUP(5,1), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION ALAW(2,1), FOUND(6,1), APROF(2,1), AFLAW(2,1)
      DOUBLE PRECISION GLAW(6,1), Z(3,1), X(1), FV(6,1), P(1), GBINF
      DOUBLE PRECISION ATAB(2,1)
      INTEGER*8 BEAM, STATE
      INTEGER ISUP(3,1), ILOAD(3,1), ILAW(1), IUNL(1), IFOUND(1)
      INTEGER IPROF(1), IFLAW(1), IGLAW(1), ITAB(2,1), IZ(2,1)
      INTEGER NZ, I, INFO, IENT
      EXTERNAL GBINF, GHCONT, GHFLDS, GHFREE, GHPRES, GHPRFD, GHSOLV,
     +         GHSTAT
      DATA FOUND /0.0D0, 12.0D0, 4*0.0D0/
      DATA GLAW /20.0D0, 8.0D0, 0.0D0, 60.0D0, 24.0D0, 0.0D0/
      DATA ALOAD /0.0D0, 12.0D0, 6.0D0, 18.0D0/
      SPAN(1,1) = 12.0D0
      DO 10 I = 2, 4
         SPAN(I,1) = GBINF()
   10 CONTINUE
      ILOAD(1,1) = 3
      ILOAD(2,1) = 0
      ILOAD(3,1) = -1
      IFOUND(1) = 1
      IGLAW(1) = 6
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -24, 'no such law')
      CALL EXPECT(IENT, 1, 'of foundation 1')
      IGLAW(1) = 4
      GLAW(5,1) = -24.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, -25, 'a limit below 0')
      GLAW(5,1) = 24.0D0
      CALL GHPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, BEAM,
     +            IENT, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'solved')
      X(1) = 5.0D0
      CALL GHFLDS(BEAM, STATE, 1, X, 0, FV, INFO)
      CALL CLOSE(FV(1,1), 0.2D0*LOG(7.0D0), '0.4 atanh(3/4)')
      CALL GHPRES(BEAM, STATE, 1, X, 0, P, INFO)
      CALL CLOSE(P(1), 11.0D0, 'the load there')
      CALL GHCONT(BEAM, STATE, 1, NZ, Z, IZ, INFO)
      CALL CHECK(NZ .EQ. 1 .AND. IZ(2,1) .EQ. 1, 'one zone')
      CALL CLOSE(Z(3,1), 144.0D0, 'its force')
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      END
C
C     A weight of 1 on two spans of 1: the far end lifts where
C     P s (1 - s**2) > 3/2, by P s (1 - s**2)/6 - 1/4
      SUBROUTINE TRAINS
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,2), HINGE(1)
      DOUBLE PRECISION AXLE(2,2), EV(4), G(2,2)
      DOUBLE PRECISION F(4,2,4), S(4,2,4,3), X(2), C(2,4,2), P(2,4,2)
      DOUBLE PRECISION Q(4,2,2), CQ(2,2,1), PQ(2,2,1)
      DOUBLE PRECISION FACT(2), SETT(3), V(4,3)
      INTEGER*8 BEAM, COMB, STATE, PASS
      DOUBLE PRECISION ZERO, R, GBINF
      INTEGER ISUP(3,3), ILOAD(3,2), IE(3,4), IG(2), N(3), K, INFO, IENT
      INTEGER KIND(3), IQ(2)
      EXTERNAL GBINF, GHCMBN, GHFREE, GHPREP, GHSOLV, GHSTAT, GHSUPP,
     +         GHTCRV, GHTQCR, GHTQXT
      EXTERNAL GHTGET, GHTRAN, GHTXTR
      PARAMETER (ZERO = 0.0D0)
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      DO 10 K = 1, 2
         SPAN(1,K) = 1.0D0
         SPAN(2,K) = 1.0D0
   10 CONTINUE
      DO 20 K = 1, 3
         ISUP(1,K) = 1
         SUP(3,K) = ZERO
         SETT(K) = ZERO
   20 CONTINUE
C     The load is 3, the weight a third of it; a second one does nothing
      ALOAD(2,1) = 2.0D0
      ILOAD(2,1) = 1
      ILOAD(1,2) = 1
      ILOAD(2,2) = 0
      ILOAD(3,2) = 1
      ALOAD(1,2) = ZERO
      ALOAD(2,2) = ZERO
      ALOAD(3,2) = 5.0D0
      ALOAD(4,2) = ZERO
      AXLE(1,1) = ZERO
      AXLE(2,1) = 8.0D0
      R = GBINF()
      BEAM = 0
      CALL GHTRAN(BEAM, 1, AXLE, ZERO, 0, ZERO, 1.0D0, PASS, N, INFO)
      CALL EXPECT(INFO, -1, 'nothing prepared')
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 2, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      FACT(1) = 1.0D0/3.0D0
      FACT(2) = R
      CALL GHCMBN(BEAM, FACT, SETT, COMB, IENT, INFO)
      CALL EXPECT(INFO, -2, 'a factor without end')
      CALL EXPECT(IENT, 2, 'of load 2')
      FACT(2) = ZERO
      SETT(3) = R
      CALL GHCMBN(BEAM, FACT, SETT, COMB, IENT, INFO)
      CALL EXPECT(INFO, -3, 'a movement without end')
      SETT(3) = ZERO
      CALL GHCMBN(BEAM, FACT, SETT, COMB, IENT, INFO)
      CALL EXPECT(INFO, 0, 'combined')
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(COMB, 1.0D0, 0, 0, STATE, INFO)
      CALL GHSUPP(COMB, STATE, V, KIND, INFO)
      CALL CLOSE(V(1,2), 1.25D0, 'its weight alone')
      CALL GHTRAN(COMB, 0, AXLE, ZERO, 0, ZERO, 1.0D0, PASS, N, INFO)
      CALL EXPECT(INFO, -2, 'no axle')
      AXLE(1,1) = -1.0D0
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 0, ZERO, 1.0D0, PASS, N, INFO)
      CALL EXPECT(INFO, -3, 'an axle before the first')
      AXLE(1,1) = ZERO
      CALL GHTRAN(COMB, 1, AXLE, R, 0, ZERO, 1.0D0, PASS, N, INFO)
      CALL EXPECT(INFO, -4, 'Q without end')
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 2, ZERO, 1.0D0, PASS, N, INFO)
      CALL EXPECT(INFO, -5, 'no such direction')
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 0, R, R, PASS, N, INFO)
      CALL EXPECT(INFO, -6, 'FROM without end')
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 0, 3.0D0, R, PASS, N, INFO)
      CALL EXPECT(INFO, -7, 'no position')
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 0, -R, R, PASS, N, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N(1) .EQ. 4 .AND. N(2) .EQ. 0,
     +           'four events')
      CALL GHTGET(PASS, -1, EV, IE, 2, G, IG, INFO)
      CALL EXPECT(INFO, -2, 'MAXEV = -1')
      CALL GHTGET(PASS, 0, EV, IE, -1, G, IG, INFO)
      CALL EXPECT(INFO, -5, 'MAXGAP = -1')
      CALL GHTGET(PASS, 4, EV, IE, 2, G, IG, INFO)
      CALL EXPECT(INFO, 0, 'which')
      CALL CHECK(IE(1,1) .EQ. 3 .AND. IE(2,1) .EQ. 0 .AND.
     +           IE(3,1) .EQ. 0 .AND. IE(1,3) .EQ. 1,
     +           'the far end opens')
      CALL CLOSE(8.0D0*EV(1)*(1.0D0 - EV(1)**2), 1.5D0, 'where')
      CALL CLOSE(EV(2) + EV(3), 2.0D0, 'the other way round')
      CALL GHFREE(PASS, INFO)
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 1, -R, R, PASS, N, INFO)
      CALL GHTGET(PASS, 1, EV(2), IE, 2, G, IG, INFO)
      CALL GHFREE(PASS, INFO)
      CALL CLOSE(EV(1) + EV(2), 2.0D0, 'to the left')
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 0, ZERO, 1.0D0, PASS, N, INFO)
      CALL GHTXTR(BEAM, PASS, F, S, INFO)
      CALL EXPECT(INFO, -2, 'over another beam')
      CALL GHTXTR(COMB, PASS, F, S, INFO)
      CALL EXPECT(INFO, 0, 'extremes')
      CALL CLOSE(F(1,1,3), 32.0D0/17.0D0, 'largest moment')
      CALL CLOSE(F(2,1,3), 8.0D0/17.0D0, 'its place')
      CALL CLOSE(F(3,1,3), 8.0D0/17.0D0, 'and position')
      CALL CLOSE(S(1,1,2,3), 8.0D0/(9.0D0*SQRT(3.0D0)) - 0.25D0,
     +           'the far end lifts')
      X(1) = 0.5D0
      X(2) = 1.0D0
      CALL GHTCRV(COMB, PASS, 2, X, C, P, INFO)
      CALL EXPECT(INFO, 0, 'curves')
      CALL CLOSE(C(1,3,1), 1.875D0, 'moment under the wheel')
      CALL CLOSE(P(1,3,1), 0.5D0, 'there')
      CALL CLOSE(C(2,3,2), -0.5D0, 'above the support')
C     EI is 1: the curvature is the moment
      IQ(1) = 8
      IQ(2) = 4
      CALL GHTQXT(COMB, PASS, 2, IQ, Q, INFO)
      CALL EXPECT(INFO, 0, 'extremes of quantities')
      CALL CLOSE(Q(1,1,1), 32.0D0/17.0D0, 'largest curvature')
      CALL CLOSE(Q(3,1,1), 8.0D0/17.0D0, 'its position')
      CALL GHTQCR(COMB, PASS, 2, IQ, 1, X, CQ, PQ, INFO)
      CALL EXPECT(INFO, 0, 'curves of quantities')
      CALL CLOSE(CQ(1,1,1), 1.875D0, 'curvature under the wheel')
      CALL CLOSE(PQ(1,1,1), 0.5D0, 'it stands there')
      CALL GHTQXT(COMB, PASS, 0, IQ, Q, INFO)
      CALL EXPECT(INFO, -3, 'NQUAN = 0')
      IQ(2) = 10
      CALL GHTQXT(COMB, PASS, 2, IQ, Q, INFO)
      CALL EXPECT(INFO, -4, 'no such quantity')
      IQ(2) = 7
      CALL GHTQCR(COMB, PASS, 2, IQ, 1, X, CQ, PQ, INFO)
      CALL EXPECT(INFO, -4, 'no ground under a train')
      CALL GHTQCR(COMB, PASS, 1, IQ, -1, X, CQ, PQ, INFO)
      CALL EXPECT(INFO, -5, 'less than no place')
      X(2) = 3.0D0
      CALL GHTCRV(COMB, PASS, 2, X, C, P, INFO)
      CALL EXPECT(INFO, -4, 'off the beam')
      CALL GHTCRV(COMB, PASS, -1, X, C, P, INFO)
      CALL EXPECT(INFO, -3, 'NX = -1')
      CALL GHFREE(PASS, INFO)
      CALL GHFREE(COMB, INFO)
      FACT(1) = -1.0D0
      CALL GHCMBN(BEAM, FACT, SETT, COMB, IENT, INFO)
      AXLE(2,1) = 1.0D0
      CALL GHTRAN(COMB, 1, AXLE, ZERO, 0, ZERO, 2.0D0, PASS, N, INFO)
      CALL GHTGET(PASS, 0, EV, IE, 2, G, IG, INFO)
      CALL CHECK(N(1) .EQ. 0 .AND. N(2) .EQ. 1 .AND.
     +           IG(1) .EQ. 1 .AND. .NOT. ABS(G(1,1)) .GT. 0.0D0 .AND.
     +           G(2,1) .GT. 1.9D0, 'lifted off')
      CALL GHTXTR(COMB, PASS, F, S, INFO)
      CALL EXPECT(INFO, 1, 'no position is solved')
      CALL GHTCRV(COMB, PASS, 1, X, C, P, INFO)
      CALL EXPECT(INFO, 1, 'nor a place of the curves')
      CALL GHFREE(PASS, INFO)
      CALL GHFREE(COMB, INFO)
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      END
C
C     Handles that are none, cases, and calls that are ended
      SUBROUTINE HANDLE
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1), F(3)
      DOUBLE PRECISION S(3,3,3), R(3,3), W(3,3), A(3,3), B(3,3), V(4,3)
      DOUBLE PRECISION GBINF
      INTEGER ISUP(3,3), ILOAD(3,1), INFO, IENT, IST(3), IC(3,3), K(3)
      INTEGER I, MANY, ASK, ASKED
      INTEGER*8 BEAM, STATE, CASES, MINE, OTHER, SHAM(4)
      EXTERNAL GBINF, ASK, GHCASE, GHFREE, GHLIMT, GHMANY, GHPREP,
     +         GHSOLV
      EXTERNAL GHSTAT, GHSTOP, GHSUPP, GHWTCH
      COMMON /WATCHD/ ASKED
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      OTHER = 0
      CALL GHFREE(OTHER, INFO)
      CALL EXPECT(INFO, -1, '0 is no handle')
      OTHER = 8
      CALL GHFREE(OTHER, INFO)
      CALL EXPECT(INFO, -1, 'nor is 8')
      DO 10 I = 1, 4
         SHAM(I) = 12345678987654321_8*I
   10 CONTINUE
C     Memory of the program's own, also in between
      MINE = LOC(SHAM)
      DO 20 I = 0, 3
         OTHER = MINE + 4*I
         CALL GHFREE(OTHER, INFO)
         CALL CHECK(INFO .EQ. -1 .AND. OTHER .EQ. MINE + 4*I,
     +              'nor is memory of others')
   20 CONTINUE
      CALL GHSOLV(MINE, 1.0D0, 0, 0, MINE, INFO)
      CALL EXPECT(INFO, -1, 'no beam')
      CALL GHPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            BEAM, IENT, INFO)
      CALL GHSTAT(STATE, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'solved')
      CALL GHSUPP(BEAM, STATE, V, K, INFO)
C     Cases: half of the load, all, all over a gap of 2
      CALL GHCASE(STATE, CASES, INFO)
      CALL CHECK(INFO .EQ. -1 .AND. CASES .EQ. 0, 'no cases of a state')
      CALL GHCASE(BEAM, CASES, INFO)
      CALL EXPECT(INFO, 0, 'cases')
      DO 40 I = 1, 3
         F(I) = MIN(0.5D0*I, 1.0D0)
         DO 30 IENT = 1, 3
            S(1,IENT,I) = 0.0D0
            S(2,IENT,I) = SUP(3,IENT)
            S(3,IENT,I) = GBINF()
   30    CONTINUE
   40 CONTINUE
      S(2,2,3) = 2.0D0
      CALL GHMANY(BEAM, BEAM, 3, F, 1, S, 0, IST, R, IC, W, A, B, INFO)
      CALL EXPECT(INFO, -2, 'a beam is no cases')
      CALL GHMANY(BEAM, CASES, -1, F, 1, S, 0, IST, R, IC, W, A, B,
     +            INFO)
      CALL EXPECT(INFO, -3, 'NCASE = -1')
      CALL GHMANY(BEAM, CASES, 3, F, 2, S, 0, IST, R, IC, W, A, B, INFO)
      CALL EXPECT(INFO, -5, 'NVARY = 2')
      CALL GHMANY(BEAM, CASES, 3, F, 1, S, 7, IST, R, IC, W, A, B, INFO)
      CALL EXPECT(INFO, -7, 'RULE = 7')
      S(3,1,2) = -1.0D0
      CALL GHMANY(BEAM, CASES, 3, F, 1, S, 0, IST, R, IC, W, A, B, INFO)
      CALL CHECK(INFO .EQ. -6 .AND. IST(1) .EQ. 2,
     +           'impossible in case 2')
      S(3,1,2) = GBINF()
      F(3) = GBINF()
      CALL GHMANY(BEAM, CASES, 3, F, 0, S, 0, IST, R, IC, W, A, B, INFO)
      CALL CHECK(INFO .EQ. -4 .AND. IST(1) .EQ. 3,
     +           'no number in case 3')
      F(3) = 1.0D0
      CALL GHMANY(BEAM, CASES, 3, F, 1, S, 0, IST, R, IC, W, A, B, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. IST(3) .EQ. 0, 'many')
      CALL CLOSE(R(2,2), V(1,2), 'as alone')
      CALL CHECK(IC(2,2) .EQ. 1 .AND. IC(2,3) .EQ. 0, 'a wide gap')
C     Ended: by the clock, by a function, from outside
      CALL GHLIMT(BEAM, -1.0D0, INFO)
      CALL EXPECT(INFO, -2, 'a time below 0')
      CALL GHLIMT(BEAM, 0.0D0, INFO)
      CALL EXPECT(INFO, 0, 'no time')
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 18, 'ended by the clock')
      ASKED = 0
      MANY = 1
      CALL GHWTCH(BEAM, ASK, MANY, -1.0D0, INFO)
      CALL EXPECT(INFO, -4, 'a time below 0')
      CALL GHWTCH(BEAM, ASK, MANY, GBINF(), INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 18, 'ended by a function')
      CALL CHECK(ASKED .GT. 0, 'it was asked')
      MANY = 0
      CALL GHWTCH(BEAM, ASK, MANY, GBINF(), INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'not ended')
      CALL GHSTOP(BEAM, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 18, 'ended from outside')
      CALL GHLIMT(BEAM, GBINF(), INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'goes on')
      CALL GHFREE(CASES, INFO)
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      CALL EXPECT(INFO, 0, 'freed')
      CALL GHFREE(BEAM, INFO)
      CALL EXPECT(INFO, -1, 'freed twice')
      CALL GHSTOP(BEAM, INFO)
      CALL EXPECT(INFO, -1, 'nothing to stop')
      END
C
C     Whether a call is to end: as its first argument says
      INTEGER FUNCTION ASK(MANY)
      INTEGER MANY(1), ASKED
      COMMON /WATCHD/ ASKED
      ASKED = ASKED + 1
      ASK = MANY(1)
      END
C
C     A column of length, stiffness and load 1, a stop at midspan below
C     a gap of 0.02: its states, how it buckles; two spans that vibrate
      SUBROUTINE COLUMN
      DOUBLE PRECISION SPAN(4,1), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION ALAW(2,1), FOUND(6,3), APROF(2,1), AFLAW(2,1)
      DOUBLE PRECISION GLAW(6,3), ATAB(2,1), AXIAL(2,1), SHEAR(3)
      DOUBLE PRECISION GBINF, PI, COMP(3), FORCE(3), V(4,3), FACT(2)
      DOUBLE PRECISION X(40), W(40), XMOM(2,40), SHARE, EV(2,2), Q(2)
      INTEGER*8 BEAM, STATE
      INTEGER ISUP(3,3), ILOAD(3,1), ILAW(1), IUNL(3), IFOUND(3)
      INTEGER IPROF(1), IFLAW(1), IGLAW(3), ITAB(2,1), INFO, IENT, I, K
      INTEGER KIND(3), N, IUNIQ, IEV(4,2), NINFO(5), IQ(2)
      EXTERNAL GBINF, GHBUCK, GHEVNT, GHFREE, GHGEVT, GHINFO, GHMODE
      EXTERNAL GHMOTN, GHPRAF, GHPRLM, GHQUAN, GHSHAP, GHSOLV, GHSTAT
      EXTERNAL GHSUPP
      EXTERNAL GHUNIQ
      DATA COMP /0.5D0, 0.9D0, 2.0D0/
      DATA FORCE /0.14714005862549203D0, 0.53807030793317657D0,
     +            1.6440875059318176D0/
      PI = ACOS(-1.0D0)
      SPAN(1,1) = 1.0D0
      SPAN(2,1) = 1.0D0
      SPAN(3,1) = GBINF()
      SPAN(4,1) = GBINF()
      DO 20 K = 1, 3
         DO 10 I = 1, 5
            SUP(I,K) = 0.0D0
   10    CONTINUE
         SUP(1,K) = 0.5D0*(K - 1)
         SUP(2,K) = GBINF()
         ISUP(1,K) = 0
         ISUP(2,K) = 0
         ISUP(3,K) = -1
   20 CONTINUE
      ISUP(1,2) = 1
      SUP(3,2) = 0.02D0
      ILOAD(1,1) = 3
      ILOAD(2,1) = 0
      ILOAD(3,1) = -1
      ALOAD(1,1) = 0.0D0
      ALOAD(2,1) = 1.0D0
      ALOAD(3,1) = 1.0D0
      ALOAD(4,1) = 1.0D0
      AXIAL(1,1) = 0.0D0
      AXIAL(2,1) = -1.0D0
      CALL GHPRAF(1, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 0, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, AXIAL,
     +            SHEAR, 0, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -29, 'a negative mass')
      CALL EXPECT(IENT, 1, 'of span 1')
      AXIAL(2,1) = 0.0D0
      DO 25 K = -1, 16, 17
         CALL GHPRAF(1, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +               0, ILAW, ALAW, IUNL, 0, IFOUND, FOUND, 0, IPROF,
     +               APROF, 0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB,
     +               ATAB, AXIAL, SHEAR, K, BEAM, IENT, INFO)
         CALL EXPECT(INFO, -31, 'no sum of 1, 2, 4 and 8')
   25 CONTINUE
      CALL GHPRLM(1, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 0, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, AXIAL,
     +            SHEAR, 0, -1, AXIAL, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -32, 'negative number of masses')
      CALL GHSTAT(STATE, INFO)
      CALL EXPECT(INFO, 0, 'state')
      DO 30 K = 1, 3
         AXIAL(1,1) = -COMP(K)*PI**2
         CALL GHPRAF(1, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +               0, ILAW, ALAW, IUNL, 0, IFOUND, FOUND, 0, IPROF,
     +               APROF, 0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB,
     +               ATAB, AXIAL, SHEAR, 0, BEAM, IENT, INFO)
         CALL EXPECT(INFO, 0, 'prepared')
         CALL GHUNIQ(STATE, IUNIQ, INFO)
         IF (K .EQ. 1) CALL EXPECT(INFO, -1, 'nothing solved')
         CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
         CALL EXPECT(INFO, 0, 'solved')
         CALL GHUNIQ(STATE, IUNIQ, INFO)
         CALL CHECK(INFO .EQ. 0 .AND. IUNIQ .EQ. 1 - K/3, 'unique')
         CALL GHSUPP(BEAM, STATE, V, KIND, INFO)
         CALL CLOSE(V(1,2), FORCE(K), 'stop')
         CALL GHMODE(BEAM, STATE, 1, 2, FACT, N, INFO)
         CALL CHECK(INFO .EQ. 0 .AND. N .EQ. 2, 'two modes')
         CALL CLOSE(FACT(1), 4.0D0/COMP(K), 'in two waves')
         IF (K .LT. 3) CALL GHFREE(BEAM, INFO)
   30 CONTINUE
      IQ(1) = 9
      IQ(2) = 4
      CALL GHQUAN(BEAM, STATE, 2, IQ, 1, 0.0D0, 0, Q, INFO)
      CALL EXPECT(INFO, 0, 'quantities')
      CALL CLOSE(Q(1), V(1,1), 'the transverse force is balanced')
      CALL CHECK(ABS(Q(2) - V(1,1)) .GT. 0.1D0, 'the shear is not')
      CALL GHSHAP(BEAM, STATE, 1, FACT(1), 4, 40, N, X, W, XMOM, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N .EQ. 17, 'seventeen places')
      CALL CLOSE(X(5), 0.25D0, 'the fifth')
      CALL CLOSE(ABS(W(5)), 1.0D0, 'where it moves most')
      CALL GHSHAP(BEAM, STATE, 1, FACT(1), 4, -1, N, X, W, XMOM, INFO)
      CALL EXPECT(INFO, -6, 'MAXX = -1')
      CALL GHSHAP(BEAM, STATE, 1, FACT(1), 0, 0, N, X, W, XMOM, INFO)
      CALL EXPECT(INFO, -5, 'NPARTS = 0')
      CALL GHSHAP(BEAM, STATE, 1, 0.0D0, 4, 0, N, X, W, XMOM, INFO)
      CALL EXPECT(INFO, -4, 'VALUE = 0')
      CALL GHMODE(BEAM, STATE, 3, 2, FACT, N, INFO)
      CALL EXPECT(INFO, -3, 'no such kind')
      CALL GHMODE(BEAM, STATE, 1, -1, FACT, N, INFO)
      CALL EXPECT(INFO, -4, 'NVAL = -1')
      CALL GHMODE(BEAM, STATE, 2, 2, FACT, N, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N .EQ. 0, 'no mass')
      CALL GHBUCK(BEAM, STATE, SHARE, 0, N, X, W, INFO)
      CALL EXPECT(INFO, -2, 'it stands')
      CALL GHEVNT(BEAM, 1.0D0, 0, 2, STATE, N, EV, IEV, INFO)
      CALL EXPECT(INFO, -1, 'GHEVNT is not for it')
      CALL GHGEVT(BEAM, 1.0D0, 0, 2, STATE, N, EV, IEV, INFO)
      CALL EXPECT(INFO, 0, 'GHGEVT is')
      CALL GHFREE(BEAM, INFO)
C     More than four times Euler's load
      AXIAL(1,1) = -5.0D0*PI**2
      CALL GHPRAF(1, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 0, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, AXIAL,
     +            SHEAR, 0, BEAM, IENT, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 2, 'it buckles')
      CALL GHINFO(STATE, Q(1), NINFO, INFO)
      CALL EXPECT(NINFO(1), 2, 'and says so')
      CALL GHBUCK(BEAM, STATE, SHARE, -1, N, X, W, INFO)
      CALL EXPECT(INFO, -4, 'MAXX = -1')
      CALL GHBUCK(BEAM, STATE, SHARE, 40, N, X, W, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N .GT. 16 .AND. N .LE. 40, 'how')
      CALL CHECK(ABS(SHARE - 0.8D0) .LT. 1.0D-12, 'share')
      DO 40 K = 1, N
         IF (ABS(SIGN(1.0D0, W(2))*W(K) - SIN(2.0D0*PI*X(K))) .GT. 1D-9)
     +      CALL CHECK(.FALSE., 'in two waves')
   40 CONTINUE
      CALL GHMOTN(BEAM, STATE, 40, N, X, W, INFO)
      CALL EXPECT(INFO, -2, 'no free motion')
      CALL GHUNIQ(STATE, IUNIQ, INFO)
      CALL EXPECT(INFO, -1, 'no state')
      CALL GHFREE(BEAM, INFO)
C     A free span of 4 between two stretches of 10 on ground, with a
C     second parameter
      SPAN(1,1) = 24.0D0
      ALOAD(2,1) = 24.0D0
      AXIAL(1,1) = 0.0D0
      AXIAL(2,1) = 1.0D0
      SUP(1,2) = 24.0D0
      SUP(3,2) = 0.0D0
      ISUP(1,2) = 0
      DO 60 K = 1, 3
         IFOUND(K) = 0
         IGLAW(K) = 0
         SHEAR(K) = 0.0D0
         FOUND(1,K) = 14.0D0*(K - 1)
         FOUND(2,K) = 10.0D0 + 14.0D0*(K - 1)
         FOUND(3,K) = 100.0D0
         FOUND(4,K) = 100.0D0
         FOUND(5,K) = 0.0D0
         FOUND(6,K) = 0.0D0
         DO 50 I = 1, 6
            GLAW(I,K) = 0.0D0
   50    CONTINUE
   60 CONTINUE
      FOUND(1,3) = 0.0D0
      FOUND(2,3) = 24.0D0
      FOUND(3,3) = 1.0D-11
      FOUND(4,3) = 1.0D-11
      SHEAR(3) = -5.0D0
      CALL GHPRAF(1, SPAN, 0, HINGE, 2, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 3, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, AXIAL,
     +            SHEAR, 0, BEAM, IENT, INFO)
      CALL EXPECT(INFO, -30, 'a negative SHEAR')
      CALL EXPECT(IENT, 3, 'of foundation 3')
      SHEAR(3) = 5.0D0
      CALL GHPRAF(1, SPAN, 0, HINGE, 2, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 3, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, 0, ITAB, ATAB, AXIAL,
     +            SHEAR, 0, BEAM, IENT, INFO)
      CALL GHSOLV(BEAM, 1.0D0, 0, 0, STATE, INFO)
      CALL EXPECT(INFO, 0, 'on ground')
      CALL GHMODE(BEAM, STATE, 2, 2, FACT, N, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N .EQ. 2, 'two frequencies')
      CALL CHECK(ABS(FACT(1) - 1.76512387529D0) .LT. 1.0D-10, 'first')
      CALL CHECK(ABS(FACT(2) - 3.80941611761D0) .LT. 1.0D-10, 'second')
      CALL GHFREE(BEAM, INFO)
      CALL GHFREE(STATE, INFO)
      END

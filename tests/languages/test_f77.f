C     The Fortran 77 interface: INFO for every argument, workspace
C     queries, closed forms. Reports in the Test Anything Protocol.
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
      DOUBLE PRECISION WORK(500), STATE(200), QUERY(1), X(1), F(6)
      DOUBLE PRECISION V(4,3), A(2,6), B(2,6), E(1)
      INTEGER ISUP(3,3), ILOAD(3,1), IWORK(300), ISTATE(100), IQ(1)
      INTEGER INFO, LW, LI, LS, LT, K(3), NEV, IE(2,1), NN
      EXTERNAL GBPREP, GBLOAD, GBSOLV, GBSUPP, GBFLDS, GBXTRM, GBEVNT
      EXTERNAL GBMOTN
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      CALL GBPREP(0, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, -1, 'NSPAN = 0')
      CALL GBPREP(2, SPAN, -1, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, -3, 'NHINGE = -1')
      CALL GBPREP(2, SPAN, 0, HINGE, -1, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, -5, 'NSUP = -1')
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, -1, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, -8, 'NLOAD = -1')
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            QUERY, -1, IQ, -1, INFO)
      CALL EXPECT(INFO, 0, 'query')
      LW = INT(QUERY(1))
      LI = IQ(1)
      CALL CHECK(LW .GT. 0 .AND. LW .LE. 500, 'length of WORK')
      CALL CHECK(LI .GT. 0 .AND. LI .LE. 300, 'length of IWORK')
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, LW - 1, IWORK, LI, INFO)
      CALL EXPECT(INFO, -12, 'WORK too short')
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, LW, IWORK, LI - 1, INFO)
      CALL EXPECT(INFO, -14, 'IWORK too short')
      SPAN(2,2) = -1.0D0
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -2, 'negative EI')
      CALL EXPECT(IWORK(1), 2, 'of span 2')
      SPAN(2,2) = 100.0D0
      HINGE(1) = 4.0D0
      CALL GBPREP(2, SPAN, 1, HINGE, 3, ISUP, SUP, 0, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, -4, 'hinge at the end')
      ISUP(1,3) = 9
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -6, 'no such side')
      CALL EXPECT(IWORK(1), 3, 'of support 3')
      ISUP(1,3) = 0
      ALOAD(2,1) = 5.0D0
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -9, 'load off the beam')
      ALOAD(2,1) = 4.0D0
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, 200, ISTATE, 100,
     +            INFO)
      CALL EXPECT(INFO, -1, 'nothing prepared')
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, QUERY, -1, IQ, -1, INFO)
      CALL EXPECT(INFO, 0, 'query of a state')
      LS = INT(QUERY(1))
      LT = IQ(1)
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, LS - 1, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, -7, 'STATE too short')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, LS, ISTATE, LT - 1,
     +            INFO)
      CALL EXPECT(INFO, -9, 'ISTATE too short')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 2, 0, STATE, LS, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, -4, 'no such rule')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 2, STATE, LS, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, -5, 'no such start')
      ISTATE(1) = 0
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 1, STATE, LS, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, -6, 'nothing to start from')
      CALL GBSUPP(WORK, IWORK, STATE, ISTATE, V, K, INFO)
      CALL EXPECT(INFO, -3, 'nothing solved')
      CALL GBXTRM(WORK, IWORK, STATE, ISTATE, A, B, INFO)
      CALL EXPECT(INFO, -3, 'nothing solved, extremes')
      CALL GBEVNT(WORK, IWORK, 0.0D0, 0, 1, STATE, LS, ISTATE, LT,
     +            NEV, E, IE, INFO)
      CALL EXPECT(INFO, -3, 'follow to 0')
      CALL GBEVNT(WORK, IWORK, 1.0D0, 0, -1, STATE, LS, ISTATE, LT,
     +            NEV, E, IE, INFO)
      CALL EXPECT(INFO, -5, 'negative room')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, LS, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, 0, 'solved')
      X(1) = -0.1D0
      CALL GBFLDS(WORK, IWORK, STATE, ISTATE, 1, X, 0, F, INFO)
      CALL EXPECT(INFO, -6, 'place off the beam')
      CALL GBFLDS(WORK, IWORK, STATE, ISTATE, -1, X, 0, F, INFO)
      CALL EXPECT(INFO, -5, 'negative number of places')
      CALL GBMOTN(WORK, IWORK, STATE, ISTATE, 3, NN, F, F, INFO)
      CALL EXPECT(INFO, -3, 'it does not move')
      CALL GBMOTN(WORK, IWORK, STATE, ISTATE, 2, NN, F, F, INFO)
      CALL EXPECT(INFO, -5, 'no room for a motion')
      ILOAD(1,1) = 0
      CALL GBLOAD(1, ILOAD, ALOAD, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -2, 'no such load')
      CALL GBLOAD(-1, ILOAD, ALOAD, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -1, 'negative number of loads')
      ILOAD(1,1) = 3
      CALL GBLOAD(1, ILOAD, ALOAD, WORK, 10, IWORK, LI, INFO)
      CALL EXPECT(INFO, -5, 'WORK too short for the loads')
      IWORK(1) = 5
      CALL GBLOAD(1, ILOAD, ALOAD, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -4, 'no beam to load')
      END
C
C     The gap closes at 5 q L**4/384 EI = 0.001
      SUBROUTINE CLOSED
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION WORK(500), STATE(200), V(4,3), X(2), F(6,2)
      DOUBLE PRECISION A(2,6), B(2,6), C(9), E(4), FREE, R, FLEX
      INTEGER ISUP(3,3), ILOAD(3,1), IWORK(300), ISTATE(100)
      INTEGER INFO, K(3), NEV, IE(2,4), KNOWN, IU(3), NI(5)
      INTEGER MAJOR, MINOR, IPATCH
      EXTERNAL GBPREP, GBLOAD, GBSOLV, GBSUPP, GBFLDS, GBXTRM, GBEVNT
      EXTERNAL GBCERT, GBINFO, GBVERS
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      FREE = 5*3.0D0*256/(384*100.0D0)
      FLEX = 64/(48*100.0D0)
      R = (FREE - 0.001D0)/FLEX
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, 0, 'longer arrays do')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 1, 0, STATE, 200, ISTATE, 100,
     +            INFO)
      CALL EXPECT(INFO, 0, 'solved by the paper''s rule')
      CALL GBSUPP(WORK, IWORK, STATE, ISTATE, V, K, INFO)
      CALL CLOSE(V(1,2), R, 'reaction past the gap')
      CALL CLOSE(V(2,2), 0.001D0, 'deflection there')
      CALL CHECK(K(1) .EQ. 2 .AND. K(2) .EQ. 1, 'conditions')
      X(1) = 1.0D0
      X(2) = 2.0D0
      CALL GBFLDS(WORK, IWORK, STATE, ISTATE, 2, X, 1, F, INFO)
      CALL CLOSE(F(4,2), V(1,1) - 6, 'shear left of the support')
      CALL CLOSE(F(3,1), V(1,1) - 1.5D0, 'moment')
      CALL GBXTRM(WORK, IWORK, STATE, ISTATE, A, B, INFO)
      CALL CLOSE(A(1,4), 6 - V(1,1), 'largest shear')
      CALL CLOSE(B(1,4), 2.0D0, 'right of the support')
      CALL GBCERT(WORK, IWORK, STATE, ISTATE, C, KNOWN, IU, INFO)
      CALL CHECK(KNOWN .EQ. 1 .AND. C(5) .LT. 1.0D-11, 'bounds')
      CALL CHECK(IU(1) + IU(2) + IU(3) .EQ. 0, 'all decided')
      CALL GBEVNT(WORK, IWORK, 1.0D0, 0, 4, STATE, 200, ISTATE, 100,
     +            NEV, E, IE, INFO)
      CALL CHECK(NEV .EQ. 1 .AND. IE(1,1) .EQ. 2 .AND. IE(2,1) .EQ. 1,
     +           'one event')
      CALL CLOSE(E(1), 0.001D0/FREE, 'its factor')
      CALL GBINFO(STATE, ISTATE, E(2), NI, INFO)
      CALL CLOSE(E(2), 1.0D0, 'state at the end')
      CALL CHECK(NI(1) .EQ. 0 .AND. NI(2) .GT. 0, 'its numbers')
      ALOAD(3,1) = 4.0D0
      CALL GBLOAD(1, ILOAD, ALOAD, WORK, 500, IWORK, 300, INFO)
      CALL GBSUPP(WORK, IWORK, STATE, ISTATE, V, K, INFO)
      CALL EXPECT(INFO, -3, 'state of the old loads')
      ILOAD(1,1) = 1
      ALOAD(1,1) = 1.0D0
      ALOAD(3,1) = 25.0D0
      CALL GBLOAD(1, ILOAD, ALOAD, WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, 0, 'another load')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, 200, ISTATE, 100,
     +            INFO)
      CALL GBSUPP(WORK, IWORK, STATE, ISTATE, V, K, INFO)
      CALL CLOSE(V(1,2), (25*44/4800.0D0 - 0.001D0)/FLEX, 'with it')
      CALL GBVERS(MAJOR, MINOR, IPATCH)
      CALL CHECK(MAJOR + MINOR + IPATCH .GT. 0, 'version')
      END
C
C     A load beyond the last support lifts the beam off the first
      SUBROUTINE TIPPED
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION WORK(500), STATE(200), X(4), D(4)
      INTEGER ISUP(3,3), ILOAD(3,1), IWORK(300), ISTATE(100)
      INTEGER INFO, NN
      EXTERNAL GBPREP, GBSOLV, GBMOTN
      CALL TWO(SPAN, ISUP, SUP, ILOAD, ALOAD)
      ISUP(1,1) = 1
      ILOAD(1,1) = 1
      ALOAD(1,1) = 4.0D0
      CALL GBPREP(2, SPAN, 0, HINGE, 2, ISUP, SUP, 1, ILOAD, ALOAD,
     +            WORK, 500, IWORK, 300, INFO)
      CALL EXPECT(INFO, 0, 'a plank')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, 200, ISTATE, 100,
     +            INFO)
      CALL EXPECT(INFO, 1, 'tips')
      CALL GBMOTN(WORK, IWORK, STATE, ISTATE, 4, NN, X, D, INFO)
      CALL CHECK(NN .EQ. 3 .AND. D(1) .LT. 0.0D0 .AND. D(3) .GT. 0.0D0,
     +           'its right end goes down')
      END
C
C     A simple beam of stiffness 1 in the middle over a support with
C     a law, a load of 2.2 on it: one that breaks, one that yields and
C     keeps a set
      SUBROUTINE LAWS
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION WORK(700), STATE(200), V(4,3), ALAW(2,3)
      DOUBLE PRECISION FACT(2), SF(2,9), EF(9), XL(2), Q(1), C(9)
      INTEGER ISUP(3,3), ILOAD(3,1), IWORK(400), ISTATE(200), ILAW(3)
      INTEGER IUNL(3), IS(6,9), IE(4,9), IL(4,2), N(5), K(3), IQ(1)
      INTEGER INFO, LW, LI, LS, LT, KNOWN, IU(3)
      EXTERNAL GBPRLW, GBHIST, GBHSOL, GBSOLV, GBEVNT, GBSUPP, GBCERT
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
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            -1, ILAW, ALAW, IUNL, WORK, 700, IWORK, 400, INFO)
      CALL EXPECT(INFO, -11, 'NLAW = -1')
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            2, ILAW, ALAW, IUNL, WORK, 700, IWORK, 400, INFO)
      CALL EXPECT(INFO, -12, 'a law that ends falling')
      CALL EXPECT(IWORK(1), 2, 'of support 2')
      SUP(2,2) = 3.0D0
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            3, ILAW, ALAW, IUNL, WORK, 700, IWORK, 400, INFO)
      CALL EXPECT(INFO, -12, 'a law and a stiffness')
      SUP(2,2) = SUP(2,1)
      IUNL(1) = 1
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            3, ILAW, ALAW, IUNL, WORK, 700, IWORK, 400, INFO)
      CALL EXPECT(INFO, -14, 'unloading without a law')
      CALL EXPECT(IWORK(1), 1, 'of support 1')
      IUNL(1) = 0
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            3, ILAW, ALAW, IUNL, Q, -1, IQ, -1, INFO)
      LW = INT(Q(1))
      LI = IQ(1)
      CALL CHECK(LW .LE. 700 .AND. LI .LE. 400, 'lengths')
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            3, ILAW, ALAW, IUNL, WORK, LW - 1, IWORK, LI, INFO)
      CALL EXPECT(INFO, -16, 'WORK too short')
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            3, ILAW, ALAW, IUNL, WORK, LW, IWORK, LI - 1, INFO)
      CALL EXPECT(INFO, -18, 'IWORK too short')
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            3, ILAW, ALAW, IUNL, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, 0, 'a support that breaks')
      CALL GBSOLV(WORK, IWORK, 0.1D0, 0, 0, STATE, 200, ISTATE, 200,
     +            INFO)
      CALL EXPECT(INFO, -1, 'depends on the way of the load')
      CALL GBEVNT(WORK, IWORK, 0.1D0, 0, 9, STATE, 200, ISTATE, 200,
     +            N(1), EF, IE, INFO)
      CALL EXPECT(INFO, -1, 'and again')
      CALL GBHIST(WORK, IWORK, 0, FACT, 0, 9, SF, IS, 9, EF, IE, 2, XL,
     +            IL, N, INFO)
      CALL EXPECT(INFO, -3, 'NFACT = 0')
      CALL GBHIST(WORK, IWORK, 1, FACT, 3, 9, SF, IS, 9, EF, IE, 2, XL,
     +            IL, N, INFO)
      CALL EXPECT(INFO, -5, 'LIMIT = 3')
      CALL GBHIST(WORK, IWORK, 1, FACT, 0, -1, SF, IS, 9, EF, IE, 2, XL,
     +            IL, N, INFO)
      CALL EXPECT(INFO, -6, 'MAXST = -1')
      CALL GBHIST(ALAW, ILAW, 1, FACT, 0, 9, SF, IS, 9, EF, IE, 2, XL,
     +            IL, N, INFO)
      CALL EXPECT(INFO, -1, 'no beam')
      CALL GBHIST(WORK, IWORK, 1, FACT, 0, 9, SF, IS, 9, EF, IE, 2, XL,
     +            IL, N, INFO)
      CALL EXPECT(INFO, 0, 'followed')
      CALL CHECK(N(2) .EQ. 1 .AND. N(3) .EQ. 1 .AND. N(4) .EQ. 4,
     +           'one event, one limit')
      CALL CLOSE(XL(1), 0.5D0, 'its factor')
      CALL CHECK(IL(1,1) .EQ. 1 .AND. IL(2,1) .EQ. 1 .AND.
     +           IL(3,1) .EQ. 1, 'what it is')
      CALL CHECK(IE(1,1) .EQ. 2 .AND. IE(2,1) .EQ. 12 .AND.
     +           IE(3,1) .EQ. 7 .AND. IE(4,1) .EQ. 2, 'it breaks')
      CALL CHECK(IS(3,1) .EQ. 1 .AND. IS(3,2) .EQ. 0 .AND.
     +           IS(6,2) .EQ. 1, 'stable before')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, 0, 0.5D0, Q, -1, IQ, -1,
     +            INFO)
      LS = INT(Q(1))
      LT = IQ(1)
      CALL CHECK(LS .LE. 200 .AND. LT .LE. 200, 'lengths of states')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, 0, 0.5D0, STATE, LS - 1,
     +            ISTATE, LT, INFO)
      CALL EXPECT(INFO, -9, 'STATE too short')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, 0, 0.5D0, STATE, LS,
     +            ISTATE, LT - 1, INFO)
      CALL EXPECT(INFO, -11, 'ISTATE too short')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, 9, 0.5D0, STATE, LS,
     +            ISTATE, LT, INFO)
      CALL EXPECT(INFO, -6, 'no such stretch')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, 0, 0.7D0, STATE, LS,
     +            ISTATE, LT, INFO)
      CALL EXPECT(INFO, -7, 'not on the path')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, IL(4,1), 0.5D0, STATE, LS,
     +            ISTATE, LT, INFO)
      CALL EXPECT(INFO, 0, 'the landing')
      CALL GBSUPP(WORK, IWORK, STATE, ISTATE, V, K, INFO)
      CALL CLOSE(V(2,2), 1.1D0, 'without the support')
      CALL CHECK(K(2) .EQ. 13, 'which is broken')
      ALAW(1,2) = 1.0D0
      ALAW(2,2) = 1.0D0
      IUNL(2) = 1
      CALL GBPRLW(2, SPAN, 0, HINGE, 3, ISUP, SUP, 1, ILOAD, ALOAD,
     +            2, ILAW, ALAW, IUNL, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, 0, 'a support that keeps a set')
      CALL GBHIST(WORK, IWORK, 2, FACT, 0, 0, SF, IS, 9, EF, IE, 0, XL,
     +            IL, N, INFO)
      CALL CHECK(N(2) .EQ. 3 .AND. N(3) .EQ. 0 .AND. N(4) .EQ. 0,
     +           'there and back')
      CALL CHECK(IE(3,1) .EQ. 4 .AND. IE(3,2) .EQ. 8 .AND.
     +           IE(3,3) .EQ. 0, 'yields, unloads, opens')
      CALL GBHSOL(WORK, IWORK, 2, FACT, 0, IE(4,3), 0.25D0, STATE, 200,
     +            ISTATE, 200, INFO)
      CALL EXPECT(INFO, 0, 'on the way back')
      CALL GBSUPP(WORK, IWORK, STATE, ISTATE, V, K, INFO)
      CALL CLOSE(V(3,2), 0.55D0, 'a gap is left')
      CALL CHECK(K(2) .EQ. 0, 'open')
      CALL GBCERT(WORK, IWORK, STATE, ISTATE, C, KNOWN, IU, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. C(3) .LT. 1.0D-14, 'certified')
      END
C
C     A rigid beam of 12 on ground that pushes up only, a force of 30 at
C     a distance of 2 from its left end: contact over three times that
      SUBROUTINE GROUND
      INTEGER LW, LI
      PARAMETER (LW = 900, LI = 600)
      DOUBLE PRECISION SPAN(4,1), SUP(5,1), ALOAD(4,2), HINGE(1)
      DOUBLE PRECISION ALAW(2,1), FOUND(6,2), APROF(2,1), AFLAW(2,2)
      DOUBLE PRECISION WORK(LW), STATE(4000), Q(1), Z(3,2), X(3), P(3)
      DOUBLE PRECISION FV(6,1), FACT(1), EF(1), SF(2,1), V(2), C(9)
      DOUBLE PRECISION GBINF
      INTEGER ISUP(3,1), ILOAD(3,2), ILAW(1), IUNL(1), IFOUND(2)
      INTEGER IPROF(1), IFLAW(2), IWORK(LI), ISTATE(1000), IQ(1)
      INTEGER IZ(2,2), IE(4,1), IS(6,1), N(5), INFO, LW1, LI1, LS, LT
      INTEGER NZ, KNOWN, I
      EXTERNAL GBINF, GBPRFD, GBSOLV, GBLOAD, GBCONT, GBFREE, GBPRES
      EXTERNAL GBPXTR, GBFLDS, GBEVNT, GBGEVT, GBHIST, GBHSOL, GBCERT
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
         FOUND(1,I) = 0.0D0
         FOUND(2,I) = 12.0D0
         FOUND(3,I) = 5.0D0
         FOUND(4,I) = 5.0D0
         FOUND(5,I) = 0.0D0
         FOUND(6,I) = 0.0D0
   10 CONTINUE
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, -1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -15, 'NFOUND = -1')
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, -1, IPROF, APROF,
     +            0, IFLAW, AFLAW, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -18, 'NPROF = -1')
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            -1, IFLAW, AFLAW, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -21, 'NFLAW = -1')
      FOUND(3,2) = -5.0D0
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 2, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -16, 'a modulus below 0')
      CALL EXPECT(IWORK(1), 2, 'of foundation 2')
      IPROF(1) = 2
      APROF(1,1) = GBINF()
      APROF(2,1) = 0.25D0
      FOUND(3,2) = 5.0D0
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 2, IFOUND, FOUND, 1, IPROF, APROF,
     +            0, IFLAW, AFLAW, Q, -1, IQ, -1, INFO)
      CALL EXPECT(INFO, -19, 'a profile at infinity')
      IFLAW(1) = 1
      IFLAW(2) = 1
      AFLAW(1,1) = 0.5D0
      AFLAW(2,1) = 1.0D0
      AFLAW(1,2) = 1.5D0
      AFLAW(2,2) = 0.5D0
      FOUND(3,1) = 0.0D0
      FOUND(4,1) = 0.0D0
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            2, IFLAW, AFLAW, WORK, LW, IWORK, LI, INFO)
      CALL EXPECT(INFO, -22, 'a law that falls')
      CALL EXPECT(IWORK(1), 1, 'of foundation 1')
      FOUND(3,1) = 5.0D0
      FOUND(4,1) = 5.0D0
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, WORK, 50, IWORK, LI, INFO)
      CALL EXPECT(INFO, -25, 'WORK too short')
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, WORK, LW, IWORK, 50, INFO)
      CALL EXPECT(INFO, -27, 'IWORK too short')
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 2, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, Q, -1, IQ, -1, INFO)
      LW1 = INT(Q(1))
      LI1 = IQ(1)
      CALL CHECK(INFO .EQ. 0 .AND. LW1 .LE. LW .AND. LI1 .LE. LI,
     +           'lengths for two loads')
      CALL GBPRFD(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, WORK, LW1, IWORK, LI1, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, Q, -1, IQ, -1, INFO)
      LS = INT(Q(1))
      LT = IQ(1)
      CALL CHECK(INFO .EQ. 0 .AND. LS .LE. 4000 .AND. LT .LE. 1000,
     +           'lengths of states')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, LS - 1, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, -7, 'STATE too short')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, LS, ISTATE, LT,
     +            INFO)
      CALL EXPECT(INFO, 0, 'solved')
      CALL GBCONT(WORK, IWORK, STATE, ISTATE, -1, NZ, Z, IZ, INFO)
      CALL EXPECT(INFO, -5, 'MAXZN = -1')
      Z(1,2) = 7.0D0
      CALL GBCONT(WORK, IWORK, STATE, ISTATE, 2, NZ, Z, IZ, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. NZ .EQ. 1 .AND. IZ(1,1) .EQ. 1 .AND.
     +           IZ(2,1) .EQ. 1 .AND. Z(1,2) .GT. 6.9D0, 'one zone')
      CALL CLOSE(Z(2,1), 6.0D0, 'its end')
      CALL CLOSE(Z(3,1), 30.0D0, 'its force')
      CALL GBFREE(WORK, IWORK, STATE, ISTATE, -1, NZ, Z, IZ, INFO)
      CALL EXPECT(INFO, -5, 'MAXFR = -1')
      CALL GBFREE(WORK, IWORK, STATE, ISTATE, 1, NZ, Z, IZ, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. NZ .EQ. 1 .AND. IZ(1,1) .EQ. 1,
     +           'one free span')
      CALL CLOSE(Z(1,1), 6.0D0, 'where it begins')
      CALL CLOSE(Z(3,1), 2.0D0, 'how far it is')
      X(1) = 0.0D0
      X(2) = 3.0D0
      X(3) = 13.0D0
      CALL GBPRES(WORK, IWORK, STATE, ISTATE, 2, X, 0, P, INFO)
      CALL EXPECT(INFO, 0, 'pressure')
      CALL CLOSE(P(1), 10.0D0, 'at the edge')
      CALL CLOSE(P(2), 5.0D0, 'in the middle')
      CALL GBPRES(WORK, IWORK, STATE, ISTATE, 3, X, 0, P, INFO)
      CALL EXPECT(INFO, -6, 'off the beam')
      CALL GBPRES(WORK, IWORK, STATE, ISTATE, -1, X, 0, P, INFO)
      CALL EXPECT(INFO, -5, 'NX = -1')
      CALL GBPXTR(WORK, IWORK, STATE, ISTATE, V, X, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. .NOT. ABS(V(2)) .GT. 0.0D0,
     +           'extremes')
      CALL CLOSE(V(1), 10.0D0, 'the largest pressure')
      X(1) = 0.0D0
      CALL GBFLDS(WORK, IWORK, STATE, ISTATE, 1, X, 0, FV, INFO)
      CALL CLOSE(FV(1,1), 2.0D0, 'deflection')
      CALL GBCERT(WORK, IWORK, STATE, ISTATE, C, KNOWN, IQ, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. KNOWN .EQ. 1 .AND. C(6) .GT. 0.0D0
     +           .AND. C(6) .LT. 1.0D-12, 'certified')
      FACT(1) = 1.0D0
      CALL GBEVNT(WORK, IWORK, 1.0D0, 0, 1, STATE, LS, ISTATE, LT, N(1),
     +            EF, IE, INFO)
      CALL EXPECT(INFO, -1, 'on the ground by GBGEVT')
      CALL GBGEVT(WORK, IWORK, 1.0D0, 0, -1, STATE, 4000, ISTATE, 1000,
     +            N(1), EF, IE, INFO)
      CALL EXPECT(INFO, -5, 'MAXEV = -1')
      CALL GBGEVT(WORK, IWORK, 1.0D0, 0, 0, STATE, 4000, ISTATE, 1000,
     +            N(1), EF, IE, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N(1) .EQ. 0, 'no change')
      CALL GBHIST(WORK, IWORK, 1, FACT, 0, 1, SF, IS, 1, EF, IE, 0, EF,
     +            IE, N, INFO)
      CALL EXPECT(INFO, -1, 'no history')
      CALL GBHSOL(WORK, IWORK, 1, FACT, 0, 0, 0.5D0, STATE, LS,
     +            ISTATE, LT, INFO)
      CALL EXPECT(INFO, -1, 'nor its states')
      ILOAD(1,2) = 1
      ILOAD(2,2) = 1
      ILOAD(3,2) = -1
      ALOAD(1,2) = 1.0D0
      ALOAD(2,2) = 0.0D0
      ALOAD(3,2) = 30.0D0
      ALOAD(4,2) = 0.0D0
      ALOAD(1,1) = 3.0D0
      CALL GBLOAD(2, ILOAD, ALOAD, WORK, LW1, IWORK, LI1, INFO)
      CALL EXPECT(INFO, 0, 'other loads')
      CALL GBCONT(WORK, IWORK, STATE, ISTATE, 2, NZ, Z, IZ, INFO)
      CALL EXPECT(INFO, -3, 'of which nothing is solved')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, 4000, ISTATE, 1000,
     +            INFO)
      CALL EXPECT(INFO, 0, 'solved again')
      CALL GBCONT(WORK, IWORK, STATE, ISTATE, 2, NZ, Z, IZ, INFO)
      CALL CLOSE(Z(2,1), 6.0D0, 'the same resultant')
      CALL CLOSE(Z(3,1), 60.0D0, 'twice as great')
      END
C
C     A rigid beam of 12 on ground whose law and load both grow
C     threefold along it: 8 tanh(20 w/8) = 6 at its left end
      SUBROUTINE CURVED
      INTEGER LW, LI
      PARAMETER (LW = 900, LI = 600)
      DOUBLE PRECISION SPAN(4,1), SUP(5,1), ALOAD(4,1), HINGE(1)
      DOUBLE PRECISION ALAW(2,1), FOUND(6,1), APROF(2,1), AFLAW(2,1)
      DOUBLE PRECISION GLAW(6,1), WORK(LW), STATE(4000), Z(3,1), X(1)
      DOUBLE PRECISION FV(6,1), P(1), GBINF
      INTEGER ISUP(3,1), ILOAD(3,1), ILAW(1), IUNL(1), IFOUND(1)
      INTEGER IPROF(1), IFLAW(1), IGLAW(1), IWORK(LI), ISTATE(1000)
      INTEGER IZ(2,1), NZ, I, INFO
      EXTERNAL GBINF, GBPRGL, GBSOLV, GBCONT, GBFLDS, GBPRES
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
      CALL GBPRGL(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, WORK, LW, IWORK, LI,
     +            INFO)
      CALL EXPECT(INFO, -24, 'no such law')
      CALL EXPECT(IWORK(1), 1, 'of foundation 1')
      IGLAW(1) = 4
      GLAW(5,1) = -24.0D0
      CALL GBPRGL(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, WORK, LW, IWORK, LI,
     +            INFO)
      CALL EXPECT(INFO, -25, 'a limit below 0')
      GLAW(5,1) = 24.0D0
      CALL GBPRGL(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, WORK, 50, IWORK, LI,
     +            INFO)
      CALL EXPECT(INFO, -27, 'WORK too short')
      CALL GBPRGL(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, WORK, LW, IWORK, 50,
     +            INFO)
      CALL EXPECT(INFO, -29, 'IWORK too short')
      CALL GBPRGL(1, SPAN, 0, HINGE, 0, ISUP, SUP, 1, ILOAD, ALOAD, 0,
     +            ILAW, ALAW, IUNL, 1, IFOUND, FOUND, 0, IPROF, APROF,
     +            0, IFLAW, AFLAW, IGLAW, GLAW, WORK, LW, IWORK, LI,
     +            INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      CALL GBSOLV(WORK, IWORK, 1.0D0, 0, 0, STATE, 4000, ISTATE, 1000,
     +            INFO)
      CALL EXPECT(INFO, 0, 'solved')
      X(1) = 5.0D0
      CALL GBFLDS(WORK, IWORK, STATE, ISTATE, 1, X, 0, FV, INFO)
      CALL CLOSE(FV(1,1), 0.2D0*LOG(7.0D0), '0.4 atanh(3/4)')
      CALL GBPRES(WORK, IWORK, STATE, ISTATE, 1, X, 0, P, INFO)
      CALL CLOSE(P(1), 11.0D0, 'the load there')
      CALL GBCONT(WORK, IWORK, STATE, ISTATE, 1, NZ, Z, IZ, INFO)
      CALL CHECK(NZ .EQ. 1 .AND. IZ(2,1) .EQ. 1, 'one zone')
      CALL CLOSE(Z(3,1), 144.0D0, 'its force')
      END
C
C     A weight of 1 on two spans of 1: the far end lifts where
C     P s (1 - s**2) > 3/2, by P s (1 - s**2)/6 - 1/4
      SUBROUTINE TRAINS
      DOUBLE PRECISION SPAN(4,2), SUP(5,3), ALOAD(4,2), HINGE(1)
      DOUBLE PRECISION WORK(900), CWORK(900), AXLE(2,2), EV(4), G(2,2)
      DOUBLE PRECISION F(4,2,4), S(4,2,4,3), X(2), C(2,4,2), P(2,4,2)
      DOUBLE PRECISION FACT(2), SETT(3), STATE(300), V(4,3), Q(1)
      DOUBLE PRECISION ZERO, R, GBINF
      INTEGER ISUP(3,3), ILOAD(3,2), IWORK(600), JWORK(600), IE(3,4)
      INTEGER IG(2), N(3), K, INFO, ISTATE(200), KIND(3), IQ(1)
      EXTERNAL GBINF, GBPREP, GBCMBN, GBTRAN, GBTXTR, GBTCRV, GBSOLV
      EXTERNAL GBSUPP
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
      IWORK(1) = 0
      CALL GBTRAN(WORK, IWORK, 1, AXLE, ZERO, 0, ZERO, 1.0D0, 4, EV, IE,
     +            2, G, IG, N, INFO)
      CALL EXPECT(INFO, -1, 'nothing prepared')
      CALL GBPREP(2, SPAN, 0, HINGE, 3, ISUP, SUP, 2, ILOAD, ALOAD,
     +            WORK, 900, IWORK, 600, INFO)
      CALL EXPECT(INFO, 0, 'prepared')
      FACT(1) = 1.0D0/3.0D0
      FACT(2) = R
      CALL GBCMBN(WORK, IWORK, FACT, SETT, CWORK, 900, JWORK, 600,
     +            INFO)
      CALL EXPECT(INFO, -3, 'a factor without end')
      CALL EXPECT(JWORK(1), 2, 'of load 2')
      FACT(2) = ZERO
      SETT(3) = R
      CALL GBCMBN(WORK, IWORK, FACT, SETT, CWORK, 900, JWORK, 600,
     +            INFO)
      CALL EXPECT(INFO, -4, 'a movement without end')
      SETT(3) = ZERO
      CALL GBCMBN(WORK, IWORK, FACT, SETT, Q, -1, IQ, -1, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. INT(Q(1)) .EQ. 900 .AND.
     +           IQ(1) .EQ. 600, 'lengths')
      CALL GBCMBN(WORK, IWORK, FACT, SETT, CWORK, 10, JWORK, 600, INFO)
      CALL EXPECT(INFO, -6, 'CWORK too short')
      CALL GBCMBN(WORK, IWORK, FACT, SETT, CWORK, 900, JWORK, 10, INFO)
      CALL EXPECT(INFO, -8, 'ICWORK too short')
      CALL GBCMBN(WORK, IWORK, FACT, SETT, CWORK, 900, JWORK, 600,
     +            INFO)
      CALL EXPECT(INFO, 0, 'combined')
      CALL GBSOLV(CWORK, JWORK, 1.0D0, 0, 0, STATE, 300, ISTATE, 200,
     +            INFO)
      CALL GBSUPP(CWORK, JWORK, STATE, ISTATE, V, KIND, INFO)
      CALL CLOSE(V(1,2), 1.25D0, 'its weight alone')
      CALL GBTRAN(CWORK, JWORK, 0, AXLE, ZERO, 0, ZERO, 1.0D0, 4, EV,
     +            IE, 2, G, IG, N, INFO)
      CALL EXPECT(INFO, -3, 'no axle')
      AXLE(1,1) = -1.0D0
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 1.0D0, 4, EV,
     +            IE, 2, G, IG, N, INFO)
      CALL EXPECT(INFO, -4, 'an axle before the first')
      AXLE(1,1) = ZERO
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, R, 0, ZERO, 1.0D0, 4, EV, IE,
     +            2, G, IG, N, INFO)
      CALL EXPECT(INFO, -5, 'Q without end')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 2, ZERO, 1.0D0, 4, EV,
     +            IE, 2, G, IG, N, INFO)
      CALL EXPECT(INFO, -6, 'no such direction')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, R, R, 4, EV, IE, 2, G,
     +            IG, N, INFO)
      CALL EXPECT(INFO, -7, 'FROM without end')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, 3.0D0, R, 4, EV, IE,
     +            2, G, IG, N, INFO)
      CALL EXPECT(INFO, -8, 'no position')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, R, -1, EV, IE,
     +            2, G, IG, N, INFO)
      CALL EXPECT(INFO, -9, 'MAXEV = -1')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, R, 0, EV, IE,
     +            -1, G, IG, N, INFO)
      CALL EXPECT(INFO, -12, 'MAXGAP = -1')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, -R, R, 4, EV, IE, 2,
     +            G, IG, N, INFO)
      CALL CHECK(INFO .EQ. 0 .AND. N(1) .EQ. 4 .AND. N(2) .EQ. 0,
     +           'four events')
      CALL CHECK(IE(1,1) .EQ. 3 .AND. IE(2,1) .EQ. 0 .AND. IE(3,1)
     +           .EQ. 0 .AND. IE(1,3) .EQ. 1, 'the far end opens')
      CALL CLOSE(8.0D0*EV(1)*(1.0D0 - EV(1)**2), 1.5D0, 'where')
      CALL CLOSE(EV(2) + EV(3), 2.0D0, 'the other way round')
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 1, -R, R, 1, EV(2), IE,
     +            2, G, IG, N, INFO)
      CALL CLOSE(EV(1) + EV(2), 2.0D0, 'to the left')
      CALL GBTXTR(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 1.0D0, F, S,
     +            INFO)
      CALL EXPECT(INFO, 0, 'extremes')
      CALL CLOSE(F(1,1,3), 32.0D0/17.0D0, 'largest moment')
      CALL CLOSE(F(2,1,3), 8.0D0/17.0D0, 'its place')
      CALL CLOSE(F(3,1,3), 8.0D0/17.0D0, 'and position')
      CALL CLOSE(S(1,1,2,3), 8.0D0/(9.0D0*SQRT(3.0D0)) - 0.25D0,
     +           'the far end lifts')
      X(1) = 0.5D0
      X(2) = 1.0D0
      CALL GBTCRV(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 1.0D0, 2, X, C,
     +            P, INFO)
      CALL EXPECT(INFO, 0, 'curves')
      CALL CLOSE(C(1,3,1), 1.875D0, 'moment under the wheel')
      CALL CLOSE(P(1,3,1), 0.5D0, 'there')
      CALL CLOSE(C(2,3,2), -0.5D0, 'above the support')
      X(2) = 3.0D0
      CALL GBTCRV(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 1.0D0, 2, X, C,
     +            P, INFO)
      CALL EXPECT(INFO, -10, 'off the beam')
      CALL GBTCRV(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 1.0D0, -1, X, C,
     +            P, INFO)
      CALL EXPECT(INFO, -9, 'NX = -1')
      FACT(1) = -1.0D0
      CALL GBCMBN(WORK, IWORK, FACT, SETT, CWORK, 900, JWORK, 600,
     +            INFO)
      AXLE(2,1) = 1.0D0
      CALL GBTRAN(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 2.0D0, 0, EV,
     +            IE, 2, G, IG, N, INFO)
      CALL CHECK(N(1) .EQ. 0 .AND. N(2) .EQ. 1 .AND. IG(1) .EQ. 1 .AND.
     +           .NOT. ABS(G(1,1)) .GT. 0.0D0 .AND. G(2,1) .GT. 1.9D0,
     +           'lifted off')
      CALL GBTXTR(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 2.0D0, F, S,
     +            INFO)
      CALL EXPECT(INFO, 1, 'no position is solved')
      CALL GBTCRV(CWORK, JWORK, 1, AXLE, ZERO, 0, ZERO, 2.0D0, 1, X, C,
     +            P, INFO)
      CALL EXPECT(INFO, 1, 'nor a place of the curves')
      END

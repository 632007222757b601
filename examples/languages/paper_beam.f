C     The paper's beam in Fortran 77: prepared once, solved in ten load
C     steps, followed from event to event.
C
C         gfortran -std=legacy paper_beam.f -o paper_beam
C        +    $(pkg-config --cflags --libs gapbeam)
C
C     The programs beside it do the same in C, Fortran and Python and
C     print the same digits.
      PROGRAM PAPER
      INTEGER NSPAN, NSUP, NLOAD
      PARAMETER (NSPAN = 3, NSUP = 4, NLOAD = 3)
      DOUBLE PRECISION SPAN(4,NSPAN), SUP(5,NSUP), ALOAD(4,NLOAD)
      INTEGER ISUP(3,NSUP), ILOAD(3,NLOAD)
      DOUBLE PRECISION HINGE(1), SUPVAL(4,NSUP), X(3), FIELD(6,3)
      DOUBLE PRECISION VALUE(2,6), PLACE(2,6), CERT(9), EVFACT(1)
      INTEGER KSTATE(NSUP), IUNDEC(NSUP), IEVENT(2,1)
      INTEGER INFO, IENTRY, K, NEV, KNOWN
      INTEGER*8 BEAM, STATE
      DOUBLE PRECISION GBINF
      EXTERNAL GBINF, GHPREP, GHSTAT, GHSOLV, GHSUPP, GHFLDS, GHXTRM
      EXTERNAL GHCERT, GHEVNT, GHFREE
      DATA X /1.0D0, 3.0D0, 5.0D0/
C     Side (0 both, 1 below, -1 above), direction, node
      DATA ISUP /0, 0, 0,  -1, 0, 1,  1, 0, 2,  1, 0, 3/
C     Kind (1 force), case (0 live), node
      DATA ILOAD /1, 0, 1,  1, 0, 2,  1, 0, 3/
C     Place and end (by node: neither counts), value, second value
      DATA ALOAD /0.0D0, 0.0D0,  0.70707D0, 0.0D0,
     +            0.0D0, 0.0D0, -4.3597D0,  0.0D0,
     +            0.0D0, 0.0D0,  2.1155D0,  0.0D0/
C
C     A clamped beam of three spans, in tf and m; the middle one of its
C     one-sided supports lifts off
      DO 10 K = 1, NSPAN
         SPAN(1,K) = 2.0D0
         SPAN(2,K) = 44.5D0
         SPAN(3,K) = GBINF()
         SPAN(4,K) = GBINF()
   10 CONTINUE
      DO 20 K = 1, NSUP
         SUP(1,K) = 0.0D0
         SUP(2,K) = GBINF()
         SUP(3,K) = 0.0D0
         SUP(4,K) = 0.0D0
         SUP(5,K) = 0.0D0
   20 CONTINUE
      SUP(5,1) = GBINF()
C
C     Handles of the beam and of its state, freed at the end
      CALL GHPREP(NSPAN, SPAN, 0, HINGE, NSUP, ISUP, SUP, NLOAD, ILOAD,
     +            ALOAD, BEAM, IENTRY, INFO)
      IF (INFO .NE. 0) GO TO 90
      CALL GHSTAT(STATE, INFO)
      IF (INFO .NE. 0) GO TO 90
      DO 30 K = 1, 10
         CALL GHSOLV(BEAM, K/10.0D0, 0, MIN(K - 1, 1), STATE, INFO)
         IF (INFO .NE. 0) GO TO 90
   30 CONTINUE
C
      CALL GHSUPP(BEAM, STATE, SUPVAL, KSTATE, INFO)
      IF (INFO .NE. 0) GO TO 90
      WRITE (*, 100) 'reaction    ', (SUPVAL(1,K), K = 1, NSUP)
      WRITE (*, 100) 'deflection  ', (SUPVAL(2,K), K = 1, NSUP)
      WRITE (*, 100) 'opening     ', (SUPVAL(3,K), K = 1, NSUP)
      WRITE (*, 100) 'couple      ', (SUPVAL(4,K), K = 1, NSUP)
      WRITE (*, 110) 'condition   ', (KSTATE(K), K = 1, NSUP)
      CALL GHFLDS(BEAM, STATE, 3, X, 0, FIELD, INFO)
      IF (INFO .NE. 0) GO TO 90
      WRITE (*, 100) 'moment      ', (FIELD(3,K), K = 1, 3)
      WRITE (*, 100) 'shear       ', (FIELD(4,K), K = 1, 3)
      WRITE (*, 100) 'rotation    ', (FIELD(2,K), K = 1, 3)
      CALL GHXTRM(BEAM, STATE, VALUE, PLACE, INFO)
      IF (INFO .NE. 0) GO TO 90
      WRITE (*, 100) 'largest     ', VALUE(1,1), VALUE(2,1)
      WRITE (*, 100) 'at          ', PLACE(1,1), PLACE(2,1)
      CALL GHCERT(BEAM, STATE, CERT, KNOWN, IUNDEC, INFO)
      IF (INFO .NE. 0) GO TO 90
      WRITE (*, 100) 'certificate ', CERT(1), CERT(2), CERT(4), CERT(5)
      CALL GHEVNT(BEAM, 1.0D0, 0, 1, STATE, NEV, EVFACT, IEVENT, INFO)
      IF (INFO .NE. 0) GO TO 90
      WRITE (*, 110) 'events      ', NEV
      CALL GHFREE(STATE, INFO)
      CALL GHFREE(BEAM, INFO)
      STOP
   90 WRITE (*, 110) 'INFO        ', INFO
      STOP 1
  100 FORMAT (A12, 4(1PE25.16))
  110 FORMAT (A12, 4I4)
      END

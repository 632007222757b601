% The paper's beam in MATLAB or GNU Octave; gapbeam_mex.c must be compiled first, see there.
model.length = [2 2 2];
model.EI = [44.5 44.5 44.5];
model.support_node = 0:3;
model.support_side = [0 -1 1 1];            % both, above, below, below
model.support_rotation = [Inf 0 0 0];       % clamped at the left end
model.load_kind = [1 1 1];                  % forces
model.load_node = 1:3;
model.load_value = [0.70707 -4.3597 2.1155];
for step = 1:10
    [supports, fields] = gapbeam_mex(model, step / 10, [1 3 5]);
end
row = @(name, values) fprintf('%-12s%s\n', name, sprintf('%25.16E', values));
row('reaction', supports.reaction);
row('deflection', supports.deflection);
row('opening', supports.opening);
row('couple', supports.couple);
fprintf('%-12s%s\n', 'condition', sprintf('%4d', supports.condition));
row('moment', fields(3, :));
row('shear', fields(4, :));
row('rotation', fields(2, :));
